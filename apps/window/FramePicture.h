// Takes a picture of a frame while it is drawn.
#pragma once

#include <QImage>
#include <QSize>

namespace teren {

/// What the current GL context has drawn so far, read before it is presented. `pixels` is the drawing's size.
QImage readFrame(QSize pixels);

}  // namespace teren
