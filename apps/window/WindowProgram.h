// What every program with a window does before and after its own work: Qt, SoQt, signals, and one sentence
// where there is no display.
#pragma once

#include <functional>

#include "teren/Result.h"

namespace teren {

/// Starts Qt, SoQt and the landscape's nodes, calls `work` and ends them. Call it once, from main's thread;
/// windows live inside `work`. Where no display can be opened, the program ends with kWorkFailed and one
/// sentence. `name` is the program's, for messages; it must outlive the program (a literal does).
Result<void> runWithWindows(const char* name, char** argv, const std::function<Result<void>()>& work);

/// From now on SIGINT and SIGTERM ask the program to end instead of ending it; runWithWindows does that, too.
void watchForEnd() noexcept;

/// Whether the person has asked the program to end by a signal (SIGINT, SIGTERM).
bool endAsked() noexcept;

}  // namespace teren
