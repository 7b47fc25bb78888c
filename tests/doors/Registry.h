// All plugins there are, the tests' hostile ones too, and an object to stand among what they make.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "teren/Object.h"
#include "teren/PluginRegistry.h"

namespace teren {

inline const PluginRegistry& registryOfAllModules() {
  static const std::shared_ptr<const PluginRegistry> registry = [] {
    std::vector<std::filesystem::path> folders = PluginRegistry::searchPath();
    for (const char* folder :
         {TEREN_TEST_MODULES "/good", TEREN_TEST_MODULES "/throwing", TEREN_TEST_WORLD_MODULES}) {
      folders.emplace_back(folder);
    }
    return PluginRegistry::load(folders);
  }();
  return *registry;
}

/// Says of its motion what it was told to say.
class Resting final : public Object {
 public:
  explicit Resting(const Motion& motion) : motion_(motion) {}
  void update(double, const Ground& ground) override { static_cast<void>(ground.height(motion_.position)); }
  Motion motion() const override { return motion_; }
  void say(const Motion& motion) { motion_ = motion; }

 private:
  Motion motion_;
};

}  // namespace teren
