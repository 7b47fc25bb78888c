// An X server without a screen, for tests of programs with a window: they depend on nobody's display.
#pragma once

#include <string>

namespace teren {

/// Runs Xvfb as long as it lives. name() is what DISPLAY must be set to; empty if the server did not start.
class PrivateDisplay {
 public:
  PrivateDisplay();
  ~PrivateDisplay();
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay& operator=(const PrivateDisplay&) = delete;

  const std::string& name() const noexcept { return name_; }

 private:
  int server_ = -1;  // process
  std::string name_;
};

}  // namespace teren
