// Draws plots by a program of its own, gnuplot, where it is installed.
#pragma once

#include <cstdio>
#include <string>

#include "teren/Result.h"

namespace teren {

/// Whether gnuplot can be started; an error says what to install.
Result<void> findGnuplot();

/// Draws what a script says, in a language whose only output is the picture, which is written to the stream.
/// Errors: it cannot be started, or has failed.
Result<void> drawWithGnuplot(const std::string& script, std::FILE* picture);

}  // namespace teren
