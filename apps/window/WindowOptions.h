// The options that every program with a window takes beside its world:
//   [--size WxH] [--seconds S] [--screenshot FILE.png] [--stats FILE.json]
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <QSize>

#include "teren/Result.h"

namespace teren {

struct WindowOptions {
  QSize size{1280, 720};          ///< of the window [pixels]
  std::optional<double> seconds;  ///< after which the program ends; empty: when the person quits
  std::string screenshot, stats;  ///< files; empty: none
};

/// Declares the options on an application, which must live as long as this.
class WindowCommandLine {
 public:
  /// `secondsDoc` says what --seconds means to this program.
  WindowCommandLine(CLI::App& application, const std::string& secondsDoc);

  /// After parsing. Errors are of the kind kWrongInput.
  Result<WindowOptions> resolve() const;

 private:
  const CLI::Option* size_;
  const CLI::Option* seconds_;
  const CLI::Option* screenshot_;
  const CLI::Option* stats_;
};

}  // namespace teren
