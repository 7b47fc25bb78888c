// What is dug into the land one flies over, beside the engine that draws it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "teren/Engine.h"
#include "teren/GroundEditor.h"
#include "teren/Result.h"
#include "teren/World.h"

namespace teren {

/// An editor of the ground and the file that keeps what it does, which is begun with the first edit. Where
/// the file cannot be had, one sentence says so, and edits are kept in memory. All calls from the engine's
/// thread; nothing waits for a disk or for the ground but setWorld to another description.
class LandEdits {
 public:
  /// Which file keeps a world's edits; an error where none can be said.
  using FileOf = std::function<Result<std::filesystem::path>(const World&)>;

  LandEdits(std::shared_ptr<const World> world, DeformerSource deformers, FileOf file);

  /// From now on the land is this one. The edits go with it where it is described by the same words; else
  /// they are those of the file of the new description.
  void setWorld(std::shared_ptr<const World> world);

  /// Whether it has the same description as their land.
  bool areOf(const World& world) const;

  /// Hands the engine what the ground has become, if anything is new: true. Its world is the one given last.
  bool handTo(Engine& engine);

  /// Why there are no stamps of this kind; nothing where there are.
  std::optional<std::string> missing(std::string_view kind) const;
  /// Stamps of one stroke come one after the other with the same number, another one than the stroke before;
  /// without a number each is a stroke of its own.
  void press(const Edit& edit, std::optional<std::uint64_t> stroke = {});
  /// Of the latest stroke, if that was pressed here; of what was found in the file, one edit. False where
  /// there is none. Where a deformer refuses a stamp, a stroke may be taken back with one of its neighbours'.
  bool undo();
  bool redo();

  std::size_t edits() const { return editor_->edits(); }
  /// How many of them do not show yet.
  std::size_t unfinished() const { return editor_->unfinished(); }
  /// What was said last is not said again before the next stroke with a number.
  std::vector<std::string> takeMessages();
  void tell(std::string message) { messages_.push_back(std::move(message)); }

 private:
  void open();

  std::shared_ptr<const World> world_;
  DeformerSource deformers_;
  FileOf file_;
  std::unique_ptr<GroundEditor> editor_;
  std::vector<std::string> messages_;
  std::string said_;                     // last
  std::vector<std::size_t> strokes_;     // how many edits counted as each began, rising; those undone too
  std::optional<std::uint64_t> stroke_;  // that goes on
};

}  // namespace teren
