// The ground that a journal of edits makes of a world, as the commands ask for it.
#pragma once

#include <memory>
#include <span>

#include "teren/EditJournal.h"
#include "teren/EditedGround.h"
#include "teren/PluginRegistry.h"
#include "teren/Result.h"
#include "teren/World.h"

#include "apps/options/EditOptions.h"
#include "apps/teren/Interruption.h"

namespace teren {

/// What to do with the ground that a journal keeps: begin with it, where it fits; or apply its edits again
/// and refuse one that they do not make.
enum class KeptGround { used, proved };

/// Applies edits one after the other, showing progress on a terminal; `record` is the journal's that they are
/// of, as far as they go. Ground that it keeps and that is not what was written is told on standard error;
/// such and what belongs to other edits, plugins or terrain by now is not used. Where `interruption` came,
/// the error says "cancelled".
Result<std::unique_ptr<EditedGround>> groundOfEdits(const std::shared_ptr<const World>& world,
                                                    const std::shared_ptr<const PluginRegistry>& registry,
                                                    std::span<const Edit> edits, const EditRecord& record,
                                                    KeptGround kept, const Interruption& interruption);

/// The same of the journal that --edits names, which must be whole; null where none is named. Errors name
/// the journal.
Result<std::unique_ptr<EditedGround>> groundOfOptions(const EditOptions& options,
                                                      const std::shared_ptr<const World>& world,
                                                      const std::shared_ptr<const PluginRegistry>& registry,
                                                      const Interruption& interruption);

}  // namespace teren
