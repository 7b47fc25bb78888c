// Hears what nodes say through SoDebugError.
#pragma once

#include <string>
#include <vector>

#include <Inventor/errors/SoDebugError.h>

namespace teren {

/// Collects what is said through SoDebugError while it lives.
class Complaints {
 public:
  Complaints() { SoDebugError::setHandlerCallback(hear, this); }
  ~Complaints() { SoDebugError::setHandlerCallback(SoDebugError::getHandlerCallback(), nullptr); }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;
  std::vector<std::string> sentences;

 private:
  static void hear(const SoError* error, void* self) {
    static_cast<Complaints*>(self)->sentences.emplace_back(error->getDebugString().getString());
  }
};

}  // namespace teren
