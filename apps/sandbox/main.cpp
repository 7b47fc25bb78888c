// teren-sandbox: sand on a triangulated irregular network, to dig, rake and heap.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <QApplication>

#include "apps/options/CommandLine.h"
#include "apps/sandbox/SandFile.h"
#include "apps/sandbox/SandScript.h"
#include "apps/sandbox/SandSession.h"
#include "apps/sandbox/SandWindow.h"
#include "apps/window/FrameReport.h"
#include "apps/window/SavedFiles.h"
#include "apps/window/WindowOptions.h"
#include "apps/window/WindowProgram.h"

namespace teren {
namespace {

constexpr const char* kName = "teren-sandbox";

/// What the command line asks for.
struct SandOptions {
  SandGround ground;
  std::string load;  // a file instead of the ground
  std::optional<SandScript> script;
  bool wireframe = false, noWindow = false;
  WindowOptions window;

  bool wantsPicture() const {
    return window.seconds || !window.screenshot.empty() || !window.stats.empty() ||
           (script && script->needsPicture());
  }
};

CLI::Option* addFlag(CLI::App& application, const std::string& name, const std::string& doc) {
  return application.add_flag(name, doc)->disable_flag_override();
}

class SandCommandLine {
 public:
  explicit SandCommandLine(CLI::App& application)
      : vertices_(application.add_option("--vertices", "of the sand, 4 to 4000000 [30000]")->type_name("N")),
        size_(application.add_option("--size-m", "side of the box in metres [1]")->type_name("M")),
        roughness_(application.add_option("--roughness-m", "how high the ground rolls, in metres [0]")
                       ->type_name("M")),
        load_(application.add_option("--load", "sand that was saved, instead of new")->type_name("FILE")),
        script_(application.add_option("--script", "do what is written there; --script-help explains it")
                    ->type_name("FILE")),
        scriptHelp_(addFlag(application, "--script-help", "list a script's commands and end")),
        noWindow_(addFlag(application, "--no-window", "play the script without one")),
        wireframe_(addFlag(application, "--wireframe", "begin with wire")),
        window_(application, "show it this long, after the script, then end") {
    for (CLI::Option* option : {vertices_, size_, roughness_}) load_->excludes(option);
    script_->excludes(scriptHelp_);
  }

  bool wantsScriptHelp() const { return scriptHelp_->count() > 0; }

  /// After parsing. Errors are of the kind kWrongInput.
  Result<SandOptions> resolve() const {
    SandOptions options;
    const Result<SandGround> ground = readGround();
    if (!ground) return ground.error();
    options.ground = *ground;
    const Result<WindowOptions> window = window_.resolve();
    if (!window) return window.error();
    options.window = *window;
    options.load = argument(*load_);
    if (load_->count() > 0 && options.load.empty()) return Error{"--load names no file"};
    if (script_->count() > 0) {
      Result<SandScript> script = SandScript::fromFile(argument(*script_));
      if (!script) return script.error();
      options.script = *std::move(script);
    }
    options.wireframe = wireframe_->count() > 0;
    options.noWindow = noWindow_->count() > 0;
    if (options.noWindow && !options.script) return Error{"--no-window needs --script"};
    if (options.noWindow && options.wantsPicture()) {
      return Error{
          "--no-window excludes --seconds, --screenshot, --stats and scripts that make a screenshot"};
    }
    return options;
  }

 private:
  Result<SandGround> readGround() const {
    SandGround ground;
    ground.vertices = 30'000;
    if (vertices_->count() > 0) {
      const Result<std::int64_t> vertices = wholeArgument("--vertices", argument(*vertices_), 4, 4'000'000);
      if (!vertices) return vertices.error();
      ground.vertices = static_cast<int>(*vertices);
    }
    if (size_->count() > 0) {
      const Result<double> side = numberArgument("--size-m", argument(*size_), 0.01, 1000.0);
      if (!side) return side.error();
      ground.side = ground.depth = *side;
    }
    if (roughness_->count() > 0) {
      const Result<double> rough = numberArgument("--roughness-m", argument(*roughness_), 0.0, 1000.0);
      if (!rough) return rough.error();
      ground.roughness = *rough;
    }
    return ground;
  }

  CLI::Option* vertices_;
  CLI::Option* size_;
  CLI::Option* roughness_;
  CLI::Option* load_;
  CLI::Option* script_;
  CLI::Option* scriptHelp_;
  CLI::Option* noWindow_;
  CLI::Option* wireframe_;
  WindowCommandLine window_;
};

/// The sand that the program begins with: in sight of the person who waits for it, so of another thread.
void bringSand(SandSession& session, const SandOptions& options) {
  if (!options.load.empty()) return session.bring([file = options.load] { return loadSand(file); });
  session.bring([ground = options.ground]() -> Result<Sandbox> { return makeSand(ground); });
}

std::unique_ptr<SandSession> emptySession(const SandOptions& options) {
  SandGround empty = options.ground;
  empty.vertices = 4;
  empty.roughness = 0.0;
  return std::make_unique<SandSession>(empty);
}

bool hasDisplay() {
  const auto isSet = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return isSet("DISPLAY") || isSet("WAYLAND_DISPLAY");
}

ExitCode playWithoutWindow(const CLI::App& application, const SandOptions& options, SandSession& session) {
  watchForEnd();
  bringSand(session, options);
  session.work([&session] { return !session.arriving() || endAsked(); });
  for (const std::string& message : session.takeMessages()) return fail(application, kWrongInput, message);
  SandPlayer player(*options.script, session, nullptr, std::cout);
  const Result<bool> played = player.play(endAsked);
  if (!played) return fail(application, player.failure(), played.error().message);
  return *played ? kSuccess : fail(application, kWorkFailed, "interrupted");
}

std::string statistics(const SandWindow& window, const SandSession& session) {
  const SandFigures figures = session.figures();
  return frameReport(window.frameTimes(), window.workTimes(),
                     {{"vertices", figures.vertices},
                      {"triangles", figures.triangles},
                      {"constrained", figures.constraints},
                      {"bytes", window.bytes()}});
}

Result<void> saveResults(const SandOptions& options, const SandWindow& window, const SandSession& session) {
  if (!options.window.screenshot.empty()) {
    const Result<void> saved = savePicture(window.lastPicture(), options.window.screenshot);
    if (!saved) return saved;
  }
  if (options.window.stats.empty()) return {};
  return saveText(statistics(window, session), options.window.stats);
}

/// `failure`: what to end with after an error.
Result<void> showSand(const SandOptions& options, SandSession& session, ExitCode& failure) {
  bringSand(session, options);
  SandWindow window(session, options.window.size, options.wireframe);
  using Duration = SandWindow::Clock::duration;
  std::optional<Duration> duration;
  if (options.window.seconds) {
    duration = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(*options.window.seconds));
  }
  window.begin(options.script ? &*options.script : nullptr, duration);
  QApplication::exec();
  if (window.error()) {
    failure = window.failure();
    return *window.error();
  }
  return saveResults(options, window, session);
}

ExitCode showInWindow(const CLI::App& application, const SandOptions& options, char** argv,
                      SandSession& session) {
  ExitCode failure = kWorkFailed;
  const Result<void> shown = runWithWindows(kName, argv, [&] { return showSand(options, session, failure); });
  return shown ? kSuccess : fail(application, failure, shown.error().message);
}

/// Without waiting for the sand that another thread still makes; all that is to be kept has been written.
[[noreturn]] void endAtOnce(ExitCode code) {
  std::cout.flush();
  std::fflush(nullptr);
  std::_Exit(code);
}

int run(int argc, char** argv) {
  CLI::App application("Sand to dig, rake and heap with the mouse; the window lists the keys.", kName);
  const SandCommandLine commandLine(application);
  if (const std::optional<ExitCode> end = parseCommandLine(application, argc, argv)) return *end;
  if (commandLine.wantsScriptHelp()) {
    std::cout << "A script holds a command a line; '#' begins a comment.\n\n" << SandScript::help();
    return kSuccess;
  }
  const Result<SandOptions> options = commandLine.resolve();
  if (!options) return fail(application, kWrongInput, options.error().message);
  const bool unseen = options->script && !options->wantsPicture() && !hasDisplay();
  const std::unique_ptr<SandSession> session = emptySession(*options);
  const ExitCode code = options->noWindow || unseen ? playWithoutWindow(application, *options, *session)
                                                    : showInWindow(application, *options, argv, *session);
  if (session->arriving()) endAtOnce(code);
  return code;
}

}  // namespace
}  // namespace teren

int main(int argc, char** argv) {
  return teren::run(argc, argv);
}
