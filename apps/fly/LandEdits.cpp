#include "apps/fly/LandEdits.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace teren {

LandEdits::LandEdits(std::shared_ptr<const World> world, DeformerSource deformers, FileOf file)
    : world_(std::move(world)), deformers_(std::move(deformers)), file_(std::move(file)) {
  open();
}

void LandEdits::open() {
  const auto refused = [this](const Error& why) {
    messages_.push_back(why.message + "; what is dug now is kept in memory only");
    editor_ = GroundEditor::open(world_, deformers_).value();  // without a file nothing can be refused
  };
  const Result<std::filesystem::path> file = file_(*world_);
  if (!file) return refused(file.error());
  Result<std::unique_ptr<GroundEditor>> editor = GroundEditor::open(world_, deformers_, *file);
  if (!editor) return refused(editor.error());
  editor_ = *std::move(editor);
}

void LandEdits::setWorld(std::shared_ptr<const World> world) {
  const bool same = areOf(*world);
  world_ = std::move(world);
  if (same) return editor_->setWorld(world_);
  for (std::string& message : editor_->takeMessages()) messages_.push_back(std::move(message));
  editor_.reset();  // it may hold the file
  strokes_.clear();
  stroke_.reset();
  open();
}

bool LandEdits::areOf(const World& world) const {
  return world.descriptionHash() == world_->descriptionHash();
}

bool LandEdits::handTo(Engine& engine) {
  const std::optional<EditedGround::Snapshot> now = editor_->take();
  if (now) engine.setEdits(now->edits, now->changed);
  return now.has_value();
}

std::optional<std::string> LandEdits::missing(std::string_view kind) const {
  const Result<DeformerKind> found = deformers_(kind);
  if (found) return std::nullopt;
  return found.error().message;
}

void LandEdits::press(const Edit& edit, std::optional<std::uint64_t> stroke) {
  if (!stroke || stroke != stroke_) {
    const std::size_t begin = editor_->canUndo();
    while (!strokes_.empty() && strokes_.back() >= begin) strokes_.pop_back();
    strokes_.push_back(begin);
    if (stroke) said_.clear();
  }
  stroke_ = stroke;
  if (const Result<void> pressed = editor_->press(edit); !pressed) tell(pressed.error().message);
}

bool LandEdits::undo() {
  const std::size_t edits = editor_->canUndo();
  if (edits == 0) return false;
  stroke_.reset();
  const auto after = std::lower_bound(strokes_.begin(), strokes_.end(), edits);
  const std::size_t left = after == strokes_.begin() ? edits - 1 : *std::prev(after);
  for (std::size_t each = edits; each > left; --each) editor_->undo();
  return true;
}

bool LandEdits::redo() {
  const std::size_t edits = editor_->canUndo(), undone = editor_->canRedo();
  if (undone == 0) return false;
  stroke_.reset();
  const auto next = std::upper_bound(strokes_.begin(), strokes_.end(), edits);
  std::size_t wanted = edits + undone;  // the end of the last stroke
  if (next == strokes_.begin()) {
    wanted = edits + 1;
  } else if (next != strokes_.end()) {
    wanted = std::min(wanted, *next);
  }
  for (std::size_t each = edits; each < wanted; ++each) editor_->redo();
  return true;
}

std::vector<std::string> LandEdits::takeMessages() {
  for (std::string& message : editor_->takeMessages()) messages_.push_back(std::move(message));
  std::vector<std::string> messages;
  for (std::string& message : std::exchange(messages_, {})) {
    if (message == said_) continue;
    said_ = message;
    messages.push_back(std::move(message));
  }
  return messages;
}

}  // namespace teren
