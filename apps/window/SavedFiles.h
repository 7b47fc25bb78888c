// Writes what a program with a window leaves behind, each file whole or not at all.
#pragma once

#include <string>
#include <string_view>

#include <QImage>

#include "teren/Result.h"

namespace teren {

/// A name for a picture taken now: in the person's folder of pictures, or else where the program runs.
std::string newPictureName();

/// Writes a PNG file. Errors: no picture, or a file that cannot be written; what was there before stays then.
Result<void> savePicture(const QImage& picture, const std::string& file);

Result<void> saveText(std::string_view text, const std::string& file);

}  // namespace teren
