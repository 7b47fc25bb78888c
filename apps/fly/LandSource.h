// Where the land comes from that the command line asks for, at first and each time a plugin's author asks for
// it again.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "teren/EditedGround.h"
#include "teren/Engine.h"
#include "teren/PluginRegistry.h"
#include "teren/Result.h"

#include "apps/fly/FlyOptions.h"
#include "apps/options/WorldOptions.h"

namespace teren {

/// The land as world file and plugins are on disk.
struct NewLand {
  std::shared_ptr<const World> world;
  std::unique_ptr<Engine> engine;
  FlyOptions options;
  std::vector<std::string> changed;  ///< ids of plugins that are not what they were before
};

/// Loads modules from copies, so that their files may be built anew, overwritten or removed meanwhile.
class LandSource {
 public:
  /// Both must have been parsed, and live as long as this.
  LandSource(const WorldOptions& world, const FlyCommandLine& fly);

  /// At first with the plugins that were there when this was made, then with those that are there now.
  /// Errors: what reloading, the command line, the world and the engine refuse, and a world of another pitch
  /// than before. Then nothing has changed, and the next try compares with the same plugins again.
  Result<NewLand> make();

  /// The deformers of the land that was made last, whichever that is when one is asked for; any thread may.
  /// Lives on without this.
  DeformerSource deformers() const;

 private:
  struct Deformers;
  const WorldOptions& world_;
  const FlyCommandLine& fly_;
  std::shared_ptr<const PluginRegistry> registry_;  // of the land that was made last
  std::shared_ptr<const PluginRegistry> latest_;    // loaded last: a try that was refused loads nothing twice
  std::shared_ptr<Deformers> deformers_;
  double pitch_ = 0.0;  // [m] 0: no land was made yet
};

}  // namespace teren
