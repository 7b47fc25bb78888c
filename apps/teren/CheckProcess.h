// A part of a check, done by this program once more in a process of its own: whatever a module does - crash,
// call exit, loop for ever, when it is loaded or later - is an answer, and nothing else is lost.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "teren/Result.h"

namespace teren {

/// What the process may use: its own processor time, and ten times as much of the clock on the wall.
using CheckLimit = std::chrono::duration<double>;

/// Runs this program with the arguments, and "--answer" with the number of a pipe to write to, and waits for
/// its end. Returns all that was written where the process ended with success, else an Error that says how it
/// ended. What it says on both of its streams goes to standard error. `goOn` is asked about fifty times a
/// second; once it returns false, or the limit is reached, the process is killed with all its children that
/// have not made a session or process group of their own. Mistakes are found out, not malice: a module that
/// writes an answer of its own is believed.
Result<std::string> runCheckProcess(std::vector<std::string> arguments, CheckLimit limit,
                                    const std::function<bool()>& goOn);

/// For the process: writes the answer to the pipe with this number. False where that is none.
bool writeCheckAnswer(int pipe, const std::string& answer);

}  // namespace teren
