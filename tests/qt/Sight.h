// What the tests of engine/qt stand on: windows on a display of their own, and looks at what a person would
// see there.
#pragma once

#include <cstdint>
#include <memory>

#include <QImage>
#include <QPoint>
#include <QWidget>

#include "qt/TerrainWidget.h"

namespace teren {

/// A seed of the standard world without its water, seen from above the ground at (0, 0), small and fine so
/// that it is there soon.
void showSmallLand(TerrainWidget& land, std::uint64_t seed = 42);

/// A window with that land in it, at rest, of kWidth x kHeight pixels.
std::unique_ptr<TerrainWidget> landAtRest();
inline constexpr int kWidth = 240, kHeight = 160;

/// Whether the widget's timer runs.
bool isWorking(const TerrainWidget& land);
/// Lets events come in until the widget rests; false where it does not within a minute.
bool comesToRest(const TerrainWidget& land);

/// The screen where the widget is, as it looks after all events are done.
QImage screenOf(const QWidget& widget);
/// [0, 1] How much of the picture is neither black nor of the haze's colour.
double landShare(const QImage& picture);
/// [0, 1] How many pixels of two pictures of one size differ.
double difference(const QImage& one, const QImage& other);

/// The widget that Open Inventor draws into: mouse events of the real world arrive there.
QWidget& canvasOf(const TerrainWidget& land);

/// Events that timers have caused while events came in for a while.
int timerEvents(int milliseconds);

}  // namespace teren
