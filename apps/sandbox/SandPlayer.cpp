#include "apps/sandbox/SandPlayer.h"

#include <array>
#include <cstdio>
#include <ostream>
#include <utility>
#include <variant>

#include "apps/sandbox/SandFile.h"

namespace teren {

SandPlayer::SandPlayer(const SandScript& script, SandSession& session, SandStage* stage, std::ostream& output)
    : script_(script), session_(session), stage_(stage), output_(output) {}

/// Whether the last command goes on.
bool SandPlayer::pending() const {
  if (session_.arriving() || session_.withinBeat()) return true;
  if (wait_ == Wait::stamps) return session_.figures().waiting > 0;
  return !session_.idle() && session_.figures().beat < lastBeat_;
}

Result<void> SandPlayer::checkRest() {
  if (!std::exchange(mustRest_, false) || session_.idle()) return {};
  failure_ = kWorkFailed;
  return Error{"the sand is not at rest after so many beats"};
}

Result<bool> SandPlayer::play(const Over& over) {
  const auto failed = [this](const std::string& sentence) {
    return next_ == 0 ? Error{sentence} : script_.errorAt(script_.commands()[next_ - 1], sentence);
  };
  for (;;) {
    if (pending()) session_.work([&] { return !pending() || over(); });
    for (const std::string& message : session_.takeMessages()) return failed(message);
    if (pending()) {
      if (over()) return false;
      continue;
    }
    if (const Result<void> rests = checkRest(); !rests) return failed(rests.error().message);
    if (quits_ || next_ == script_.commands().size()) return true;
    const SandCommand& command = script_.commands()[next_++];
    failure_ = kWrongInput;
    if (const Result<void> done = run(command); !done) return failed(done.error().message);
    if (over()) return false;
  }
}

Result<void> SandPlayer::run(const SandCommand& command) {
  wait_ = Wait::stamps;
  return std::visit([this](const auto& what) { return act(what); }, command.what);
}

Result<void> SandPlayer::act(const NewSand& command) {
  session_.bring([ground = command.ground]() -> Result<Sandbox> { return makeSand(ground); });
  return {};
}

Result<void> SandPlayer::act(const TakeTool& command) {
  return session_.setTool(command.values);
}

Result<void> SandPlayer::act(const SetRepose& command) {
  session_.setRepose(command.angle, session_.moisture());
  return {};
}

Result<void> SandPlayer::act(const SetMoisture& command) {
  session_.setRepose(session_.repose(), command.moisture);
  return {};
}

Result<void> SandPlayer::act(const SetSlides& command) {
  session_.setSlides(command.on);
  return {};
}

Result<void> SandPlayer::act(const Stroke& command) {
  if (const Result<void> pressed = session_.press(command.places.front()); !pressed) return pressed;
  Result<void> dragged;
  for (std::size_t n = 1; n < command.places.size() && dragged; ++n) {
    dragged = session_.dragTo(command.places[n], command.speed);
  }
  session_.release();
  return dragged;
}

Result<void> SandPlayer::act(const RunBeats& command) {
  wait_ = Wait::beats;
  lastBeat_ = session_.figures().beat + command.most;
  mustRest_ = command.mustRest;
  return {};
}

Result<void> SandPlayer::act(Deed deed) {
  switch (deed) {
    case Deed::undo:
      if (!session_.undo()) return Error{"there is nothing to take back"};
      return {};
    case Deed::redo:
      if (!session_.redo()) return Error{"there is nothing to do again"};
      return {};
    case Deed::printHash: {
      std::array<char, 32> line{};
      std::snprintf(line.data(), line.size(), "hash %016llx\n",
                    static_cast<unsigned long long>(hashOf(session_.sandbox().surface())));
      output_ << line.data() << std::flush;
      return {};
    }
    case Deed::printCounts: {
      const SandFigures figures = session_.figures();
      output_ << "vertices " << figures.vertices << " triangles " << figures.triangles << " constrained "
              << figures.constraints << std::endl;
      return {};
    }
    case Deed::quit:
      quits_ = true;
  }
  return {};
}

Result<void> SandPlayer::act(const UseFile& command) {
  const std::string& file = command.file;
  if (command.use == UseFile::Use::load) {
    session_.bring([file] { return loadSand(file); });
    return {};
  }
  failure_ = kWorkFailed;
  if (command.use == UseFile::Use::save) return saveSand(file, session_.sandbox());
  if (command.use == UseFile::Use::exportObj) return exportObj(file, session_.sandbox());
  if (stage_ == nullptr) return Error{"a screenshot takes a window"};
  return stage_->screenshot(file);
}

Result<void> SandPlayer::act(const SetWireframe& command) {
  if (stage_ != nullptr) stage_->setWireframe(command.on);
  return {};
}

Result<void> SandPlayer::act(const SetCamera& command) {
  if (stage_ != nullptr) stage_->setCamera(command.values);
  return {};
}

}  // namespace teren
