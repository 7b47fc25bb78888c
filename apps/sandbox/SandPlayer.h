// Plays a script into a sandbox, in slices, so that a window stays alive meanwhile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>

#include "teren/Result.h"

#include "apps/options/CommandLine.h"
#include "apps/sandbox/SandScript.h"
#include "apps/sandbox/SandSession.h"

namespace teren {

/// Where a script's pictures are made.
class SandStage {
 public:
  virtual ~SandStage() = default;
  virtual void setWireframe(bool on) = 0;
  virtual void setCamera(const Values& values) = 0;
  /// What is to be seen now, as a PNG file.
  virtual Result<void> screenshot(const std::string& file) = 0;
};

/// A command takes effect when the one before is done: a stroke when its last beat is over, sand when it is
/// there. Nothing is computed between commands. So what a script makes depends on the script alone.
class SandPlayer {
 public:
  using Over = std::function<bool()>;

  /// All of them must outlive it. What commands print goes to `output`. Without a stage nothing is shown, and
  /// a screenshot is an error.
  SandPlayer(const SandScript& script, SandSession& session, SandStage* stage, std::ostream& output);

  /// Plays on until the script is over (true) or `over` says so, which is asked after each slice. An error
  /// names the script's line and ends it.
  Result<bool> play(const Over& over);
  /// What a program should end with after an error: wrong input, or work that failed.
  ExitCode failure() const noexcept { return failure_; }
  /// The script wants the program to end.
  bool quits() const noexcept { return quits_; }

 private:
  bool pending() const;
  Result<void> checkRest();
  Result<void> run(const SandCommand& command);
  Result<void> act(const NewSand& command);
  Result<void> act(const TakeTool& command);
  Result<void> act(const SetRepose& command);
  Result<void> act(const SetMoisture& command);
  Result<void> act(const SetSlides& command);
  Result<void> act(const Stroke& command);
  Result<void> act(const RunBeats& command);
  Result<void> act(Deed deed);
  Result<void> act(const UseFile& command);
  Result<void> act(const SetWireframe& command);
  Result<void> act(const SetCamera& command);

  const SandScript& script_;
  SandSession& session_;
  SandStage* stage_;
  std::ostream& output_;
  std::size_t next_ = 0;

  enum class Wait { stamps, beats } wait_ = Wait::stamps;
  std::uint64_t lastBeat_ = 0;  // of Wait::beats
  bool mustRest_ = false;
  ExitCode failure_ = kWrongInput;
  bool quits_ = false;
};

}  // namespace teren
