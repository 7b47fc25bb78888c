// teren: plugins, parameters, pieces and points of the landscape, from the command line.
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <iostream>
#include <new>
#include <unistd.h>
#include <vector>

#include "teren/Quote.h"

#include "apps/options/CommandLine.h"
#include "apps/teren/Command.h"

namespace {

/// Takes the numbers of standard streams that are closed, so that no file opened later gets one and is
/// written into by what is meant for a person. What holds their place refuses to be read or written, as they
/// did.
void holdClosedStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1) open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

/// Answers that could not be written (a full disk, say) are a failure too.
teren::ExitCode finish(const CLI::App& application, teren::ExitCode code) {
  std::cout.flush();
  if (std::cout && std::fflush(stdout) == 0) return code;
  return teren::fail(application, teren::kWorkFailed, "standard output cannot be written");
}

teren::ExitCode run(const CLI::App& application, teren::Command& command) {
  try {
    return command.run();
  } catch (const std::bad_alloc&) {
    return teren::fail(application, teren::kWorkFailed, "there is not enough memory for this");
  } catch (const std::exception& exception) {
    return teren::fail(application, teren::kWorkFailed, teren::shortened(exception.what(), 400));
  }
}

}  // namespace

int main(int argumentCount, char** arguments) {
  holdClosedStreams();
  CLI::App application("Teren on the command line: plugins, parameters, pieces and points of the landscape",
                       "teren");
  std::vector<std::unique_ptr<teren::Command>> commands;
  commands.push_back(teren::makePluginsCommand(application));
  commands.push_back(teren::makeDescribeCommand(application));
  commands.push_back(teren::makeBakeCommand(application));
  commands.push_back(teren::makeQueryCommand(application));
  commands.push_back(teren::makeEditsCommand(application));
  commands.push_back(teren::makeFlightCommand(application));
  commands.push_back(teren::makeNewPluginCommand(application));
  commands.push_back(teren::makeCheckCommand(application));
  commands.push_back(teren::makeSandCommand(application));
  commands.push_back(teren::makeReportCommand(application));
  application.require_subcommand(0, 1);

  if (const auto code = teren::parseCommandLine(application, argumentCount, arguments)) {
    return finish(application, *code);
  }
  for (const auto& command : commands) {
    if (command->chosen()) return finish(application, run(application, *command));
  }
  return teren::fail(
      application, teren::kWrongInput,
      "a command is missing: plugins, describe, bake, query, edits, flight, new-plugin, check, "
      "sand or report (see teren --help)");
}
