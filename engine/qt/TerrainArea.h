// The part of a TerrainWidget that Open Inventor draws into.
#pragma once

#include <cstdint>
#include <functional>

#include <Inventor/Qt/SoQtRenderArea.h>

namespace teren {

/// A SoQt render area that draws when its scene changes, when it is uncovered and when told to, and never
/// while it is hidden.
class TerrainArea : public SoQtRenderArea {
 public:
  /// `drawn` is called after every drawing.
  TerrainArea(QWidget* parent, std::function<void()> drawn);
  /// Tells Coin that the GL context goes, so that nodes give back what they hold in it: delete it before
  /// them.
  ~TerrainArea() override;

 protected:
  void initGraphic() override;
  void redraw() override;
  void actualRedraw() override;

 private:
  std::function<void()> drawn_;
  std::uint32_t context_ = 0;
};

}  // namespace teren
