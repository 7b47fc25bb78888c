// Two sliders under the picture: how far the land is drawn, and how far it may be off.
#pragma once

#include <functional>
#include <optional>

#include <QLabel>
#include <QSlider>
#include <QWidget>

#include "teren/Engine.h"

namespace teren {

/// A strip of one line. It never takes the keyboard, so the keys stay the flight's; it offers nothing that
/// the engine would refuse for itself. Its parts are found by their object names: the sliders "distance" and
/// "pixelError".
class DetailPanel : public QWidget {
 public:
  /// `change` is called when a person has moved a slider, with what it says.
  struct Actions {
    std::function<void(double)> setDistance;    // [m]
    std::function<void(double)> setPixelError;  // [px]
  };
  DetailPanel(Actions actions, QWidget* parent);

  /// Shows these values, without an action; in a view of one level there is nothing to choose.
  void showDetail(const std::optional<DetailSettings>& detail);

 private:
  QSlider* add(const char* name, const char* text, int steps, QLabel*& value);

  QSlider* distance_;
  QSlider* pixelError_;
  QLabel* distanceText_ = nullptr;
  QLabel* pixelErrorText_ = nullptr;
};

}  // namespace teren
