#include "apps/teren/EditedWorld.h"

#include <chrono>
#include <filesystem>
#include <iostream>

#include "teren/EditJournal.h"
#include "teren/Quote.h"

#include "apps/teren/ProgressLine.h"

namespace teren {

Result<std::unique_ptr<EditedGround>> groundOfEdits(const std::shared_ptr<const World>& world,
                                                    const std::shared_ptr<const PluginRegistry>& registry,
                                                    std::span<const Edit> edits, const EditRecord& record,
                                                    KeptGround kept, const Interruption& interruption) {
  ProgressLine line("edits");
  auto ground = std::make_unique<EditedGround>(world, deformersOf(registry));
  const EditWork work{std::chrono::milliseconds(20), [&] {
                        line.show(ground->edits(), edits.size());
                        return !interruption.came() && !world->failure();
                      }};
  if (kept == KeptGround::proved) {
    if (record.withoutCheckpoint) return *record.withoutCheckpoint;
    if (record.checkpoint) {
      const Result<void> proved = ground->prove(*record.checkpoint, edits, work);
      if (!proved) {
        return Error{"the ground that it keeps is wrong (teren edits compact makes it anew): " +
                     proved.error().message};
      }
    }
  } else {
    if (record.withoutCheckpoint) std::cerr << "teren: " << record.withoutCheckpoint->message << '\n';
    if (record.checkpoint) {
      const Result<bool> adopted = ground->adopt(record.checkpoint, edits, work);
      if (!adopted) return adopted.error();
    }
  }
  Result<void> done = ground->replay(edits, work);
  if (done) done = ground->rest(work);
  if (!done) return done.error();
  return ground;
}

Result<std::unique_ptr<EditedGround>> groundOfOptions(const EditOptions& options,
                                                      const std::shared_ptr<const World>& world,
                                                      const std::shared_ptr<const PluginRegistry>& registry,
                                                      const Interruption& interruption) {
  if (!options.given()) return std::unique_ptr<EditedGround>();
  const Result<std::filesystem::path> file = options.named();
  if (!file) return file.error();
  const Result<EditRecord> record = EditJournal::read(*file, world->descriptionHash());
  if (!record) return record.error();
  if (record->damage) return *record->damage;
  Result<std::unique_ptr<EditedGround>> ground =
      groundOfEdits(world, registry, record->history.edits, *record, KeptGround::used, interruption);
  if (!ground) return Error{inQuotes(file->string()) + ", " + ground.error().message};
  return ground;
}

}  // namespace teren
