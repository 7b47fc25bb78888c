// For tests to which it matters what the engine has measured of its world.
#pragma once

#include <chrono>
#include <thread>

#include "teren/Engine.h"

#include "world/NodeErrors.h"

namespace teren::test {

/// Updates until the errors of the world's nodes are measured, which takes place while nothing else is
/// wanted; at most two minutes, for machines that are busy with something else. True: they are.
inline bool measureNodeErrors(Engine& engine) {
  const NodeErrors& errors = engine.world().nodeErrors();
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (errors.nextToCalibrate() <= errors.topLevel() && std::chrono::steady_clock::now() < end) {
    engine.update(0.0, std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::microseconds(100));  // workers have a turn
  }
  return errors.nextToCalibrate() > errors.topLevel();
}

}  // namespace teren::test
