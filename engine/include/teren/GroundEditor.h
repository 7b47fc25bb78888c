// Tools in the hands of somebody who flies: edits are applied beside the drawing, kept in a journal, and
// shown once they are safe there.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "teren/Edit.h"
#include "teren/EditedGround.h"
#include "teren/Result.h"
#include "teren/World.h"

namespace teren {

/// Has a thread of its own, which does what is asked in the order in which it comes, lets the ground come to
/// rest after each edit, and hands out what it has become; whoever draws passes that on to Engine::setEdits
/// and waits for nothing. What is handed out has been acknowledged by the journal, so what was shown is there
/// again after the program has died, and with it what can be undone and redone. The ground is what the list
/// of edits that count gives anywhere (law 1). All member functions from one thread at a time.
class GroundEditor {
 public:
  /// Begins to apply what the journal holds. A file that is not there is begun with the first edit, its
  /// folders with it. Without a file, with one that another program is writing and with one that cannot be
  /// written (both are told by takeMessages()), edits are kept in memory. Refuses, and leaves as it is, any
  /// other file that EditJournal::open refuses.
  static Result<std::unique_ptr<GroundEditor>> open(std::shared_ptr<const World> world,
                                                    DeformerSource deformers,
                                                    const std::optional<std::filesystem::path>& journal = {});
  /// Does and keeps all that was asked, and leaves the ground in the journal for who opens it next; undos and
  /// redos after the last press are kept without being applied. But while what the journal held is being
  /// applied for the first time, it gives that up, and what was asked meanwhile, of which nobody has seen
  /// anything.
  ~GroundEditor();
  GroundEditor(const GroundEditor&) = delete;
  GroundEditor& operator=(const GroundEditor&) = delete;

  /// Presses a tool in; Edit::steps is filled in. Refuses what checkEdit refuses, and where kMostWaiting wait
  /// already. What the deformer refuses is told by takeMessages(), and the ground stays as it was. Ends what
  /// could be redone. Of many that wait, something is shown every 16 or 50 ms, or after one that takes
  /// longer.
  Result<void> press(const Edit& edit);
  /// Takes the latest edit back: the ground becomes what the list without it gives, bit for bit. Nothing
  /// happens where there is none. Several that wait are done as one.
  void undo();
  /// Lets the latest edit that was taken back count again; nothing happens where there is none.
  void redo();
  static constexpr std::size_t kMostWaiting = 4096;
  /// How many edits can be taken back, and brought back, once all that was asked is done.
  std::size_t canUndo() const;
  std::size_t canRedo() const;

  /// The same edits on another world of the same description, its plugins made anew. From now on snapshots
  /// are of that one's ground.
  void setWorld(std::shared_ptr<const World> world);

  /// What the ground has become since it was last asked for; nothing where nothing is new.
  std::optional<EditedGround::Snapshot> take();

  /// How much that was asked is not yet done, or not yet taken; edits that must be applied again count.
  std::size_t unfinished() const;
  /// How many edits count.
  std::size_t edits() const;
  /// Sentences since the last call: edits refused, journals that cannot be written.
  std::vector<std::string> takeMessages();

 private:
  class Work;
  explicit GroundEditor(std::unique_ptr<Work> work);
  std::unique_ptr<Work> work_;
};

}  // namespace teren
