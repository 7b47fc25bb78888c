// The tools with which one digs in flight: what each presses into the ground, how large, how deep, and where
// along the way of a hand.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "teren/Edit.h"
#include "teren/Position.h"

namespace teren {

/// What a tool must know of a world to fit its ground.
struct ToolGround {
  double pitch = 64.0;   ///< [m]
  double spacing = 2.0;  ///< [m] between samples at level 0
};

/// One tool at a time is in hand, or none. While it is pressed it stamps along the way its aim goes.
class ToolBelt {
 public:
  enum class Tool : std::uint8_t { dig, heap, smooth, crater, rake, shovel, pour };
  /// Whether there is a deformer of this kind.
  using IsThere = std::function<bool(std::string_view kind)>;

  static constexpr int kMostStampsAtOnce = 24;  ///< where the aim jumps farther, what lies between stays
  /// [samples] Size and depth of tools in sand, whose slides take the longer the more of it there is.
  static constexpr double kMostSand = 16.0, kDeepestSand = 4.0;

  /// A deformer that a tool is made of.
  static std::string_view kindOf(Tool tool) noexcept;
  static std::string_view nameOf(Tool tool) noexcept;

  /// Takes the next tool whose deformer is there; after the last, none. Returns those passed over.
  std::vector<Tool> takeNext(const IsThere& isThere);
  std::optional<Tool> inHand() const noexcept { return inHand_; }

  /// The ground that its tools must fit from now on.
  void standOn(const ToolGround& ground) noexcept { ground_ = ground; }
  /// [m] Its radius, and how deep it goes: no deeper than large. Of smooth: over how far it evens out.
  double size() const noexcept;
  double depth() const noexcept;
  /// By steps.
  void resize(int direction) noexcept;
  void deepen(int direction) noexcept;

  /// The stamps of a press at `aim`: the first begins a stroke, those after it follow the aim in a straight
  /// line, spacing() apart. The rake begins once it knows which way it goes. Nothing without a tool.
  std::vector<Edit> press(const Position& aim);
  /// Ends the stroke.
  void lift() noexcept {
    last_.reset();
    ++stroke_;
  }
  /// Of the stroke that goes on or comes next; each has another one.
  std::uint64_t stroke() const noexcept { return stroke_; }
  /// [m] Between stamps of a stroke.
  double spacing() const noexcept;

 private:
  bool isInSand() const noexcept;
  void begin(const Position& aim, std::vector<Edit>& edits);
  Edit stamp(const Position& place, double east, double north) const;

  ToolGround ground_;
  std::optional<Tool> inHand_;
  double size_ = 20.0, depth_ = 4.0;  // [m]
  std::optional<Position> last_;      // of the stroke
  std::uint64_t stroke_ = 0;
};

/// One press of the deformer "sand" (plugins/sand), with its tool of this name; pushed along in a direction
/// (any length), or for none of length 0 straight down. With a negative depth sand is poured.
Edit sandEdit(const Position& place, double pitch, std::string tool, double size, double depth, double east,
              double north);
/// One stamp of the deformer "crater": without a rim a plain bowl, or with a negative depth its mould. Its
/// outline is a circle where `irregularity` is 0; its seed comes from its place.
Edit craterEdit(const Position& place, double pitch, double size, double depth, double rim,
                double irregularity);

}  // namespace teren
