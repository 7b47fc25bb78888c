// What a person would do in a sandbox, written down: a plain text, a command a line, read and checked whole
// before anything is done.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Result.h"

#include "apps/sandbox/SandGround.h"
#include "apps/sandbox/SandSession.h"

namespace teren {

// The commands, in the order in which SandScript::help() explains them.
struct NewSand {
  SandGround ground;
};
struct TakeTool {
  Values values;  // of SandTool::parameters()
};
struct SetRepose {
  double angle = 0.0;  // [degree]
};
struct SetMoisture {
  double moisture = 0.0;
};
struct SetSlides {
  bool on = true;
};
/// The tool is pressed in at the first place and dragged to the others, a beat a stamp.
struct Stroke {
  std::vector<ToolPlace> places;
  double speed = 0.0;  // [m/s]
};
/// So many beats at most, fewer where all is at rest before; where it must come to rest, it is an error if
/// not.
struct RunBeats {
  std::uint64_t most = 0;
  bool mustRest = false;
};
enum class Deed { undo, redo, printHash, printCounts, quit };
struct UseFile {
  enum class Use { save, load, exportObj, screenshot };
  Use use = Use::save;
  std::string file;
};
struct SetWireframe {
  bool on = true;
};
struct SetCamera {
  Values values;  // of cameraParameters()
};

struct SandCommand {
  int line = 0;
  std::variant<NewSand, TakeTool, SetRepose, SetMoisture, SetSlides, Stroke, RunBeats, Deed, UseFile,
               SetWireframe, SetCamera>
      what;
};

/// A line holds a command and its values; '#' begins a comment, "quotation marks" hold spaces together.
/// Limits: 4 MiB, 16 KiB a line, 100,000 commands, 4 MiB of tools' outlines, those of files too. Errors name
/// the file and the line, and say in one sentence what is wrong and what was expected.
class SandScript {
 public:
  static Result<SandScript> fromFile(const std::string& file);
  /// `source` names it in messages.
  static Result<SandScript> fromText(std::string_view text, const std::string& source);

  std::span<const SandCommand> commands() const noexcept { return commands_; }
  /// "FILE, line N: SENTENCE", N the line of a command.
  Error errorAt(const SandCommand& command, const std::string& sentence) const;
  /// Whether a command makes a picture, so that it takes a display to play it.
  bool needsPicture() const noexcept;

  /// Every command, a line each.
  static std::string help();

 private:
  explicit SandScript(std::string source) : source_(std::move(source)) {}
  Error errorAt(int line, const std::string& sentence) const;

  std::string source_;
  std::vector<SandCommand> commands_;
};

/// The view onto the sand: turn and tilt [degree] and distance [m, 0: all in view] of the eye, and the place
/// it looks at [m]: x, y, z from the middle of the sand as it came. turn 0 looks north, tilt 90 straight
/// down.
std::span<const Parameter> cameraParameters() noexcept;

}  // namespace teren
