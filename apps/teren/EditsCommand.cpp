// teren edits WORLD list | apply FILE | verify | compact [--edits FILE] [--json]: what was done to a
// landscape, written down, done again, checked.
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "teren/Edit.h"
#include "teren/EditJournal.h"
#include "teren/Quote.h"

#include "apps/files/InputFile.h"
#include "apps/options/EditOptions.h"
#include "apps/options/WorldOptions.h"
#include "apps/teren/Command.h"
#include "apps/teren/EditedWorld.h"
#include "apps/teren/Interruption.h"
#include "apps/teren/JsonOutput.h"

namespace teren {
namespace {

OrderedJson asJson(const Edit& edit) {
  OrderedJson parameters = OrderedJson::object();
  for (const auto& [name, value] : edit.parameters) {
    std::visit([&, &key = name](const auto& one) { parameters[key] = one; }, value);
  }
  return {{"kind", edit.kind}, {"x", edit.x},         {"y", edit.y},
          {"z", edit.z},       {"size", edit.size},   {"depth", edit.depth},
          {"seed", edit.seed}, {"steps", edit.steps}, {"parameters", std::move(parameters)}};
}

class EditsCommand final : public Command {
 public:
  explicit EditsCommand(CLI::App& parent)
      : Command(parent, "edits", "list, apply, verify or compact what was done to a landscape"),
        world_(application()),
        edits_(application(), "[beside the world's description, or in the user's data folder]"),
        action_(
            application()
                .add_option("ACTION",
                            "list: every edit that counts, a line each; apply: those of a text, after those "
                            "that are there; verify: that all are good, and what they make; compact: "
                            "leave out what undo made void")
                ->type_name("list|apply|verify|compact")),
        text_(application().add_option("TEXT", "the text to apply")->type_name("FILE")),
        json_(addJson()) {}

  ExitCode run() override {
    const std::string action = argument(*action_);
    constexpr std::array<const char*, 4> kActions = {"list", "apply", "verify", "compact"};
    if (std::find(kActions.begin(), kActions.end(), action) == kActions.end()) {
      return fail(kWrongInput, "edits: the ACTION is " + inQuotes(action) +
                                   ", expected list, apply FILE, verify or compact");
    }
    if ((action == "apply") != (text_->count() > 0)) {
      return fail(kWrongInput, action == "apply" ? "edits apply: the FILE of edits to apply is missing"
                                                 : "edits " + action + ": " + inQuotes(argument(*text_)) +
                                                       " follows, which only apply knows what to do with");
    }
    registry_ = PluginRegistry::standard();
    const Result<std::shared_ptr<const World>> world = world_.create(*registry_);
    if (!world) return fail(kWrongInput, world.error().message);
    const Result<std::filesystem::path> file = edits_.file(world_, **world);
    if (!file) return fail(kWrongInput, file.error().message);
    if (action == "list") return list(*file, **world);
    if (action == "apply") return apply(*file, *world);
    return action == "verify" ? verify(*file, *world) : compact(*file, *world);
  }

 private:
  ExitCode list(const std::filesystem::path& file, const World& world) const {
    const Result<EditRecord> record = EditJournal::read(file, world.descriptionHash());
    if (!record) return fail(kWrongInput, record.error().message);
    if (json_->count() > 0) {
      OrderedJson edits = OrderedJson::array();
      for (const Edit& edit : record->history.edits) edits.push_back(asJson(edit));
      printJson(
          {{"file", file.string()}, {"edits", std::move(edits)}, {"undone", record->history.undone.size()}});
    } else {
      for (const Edit& edit : record->history.edits) std::cout << editText(edit) << '\n';
    }
    return record->damage ? fail(kWrongInput, record->damage->message) : kSuccess;
  }

  /// All edits of the text, or none.
  ExitCode apply(const std::filesystem::path& file, const std::shared_ptr<const World>& world) const {
    const Interruption interruption;
    const std::string name = argument(*text_);
    const Result<std::string> text = readFile(name, kMostEditListBytes);
    if (!text) return fail(kWrongInput, text.error().message + ", expected a list of edits");
    const Result<std::vector<Edit>> added = parseEdits(*text, name);
    if (!added) return fail(kWrongInput, added.error().message);
    std::error_code ignored;  // what cannot be looked at is not there, or will be refused
    const bool isNew = !std::filesystem::exists(file, ignored);
    Result<EditRecord> record = isNew ? EditRecord() : EditJournal::read(file, world->descriptionHash());
    if (!record) return fail(kWrongInput, record.error().message);
    if (record->damage) return fail(kWrongInput, record->damage->message);
    std::vector<Edit> all = record->history.edits;
    all.insert(all.end(), added->begin(), added->end());
    const std::string consequence = "nothing was added to " + inQuotes(file.string());
    if (all.size() > kMostEdits) {
      return fail(kWrongInput, consequence + ": it would have " + std::to_string(all.size()) +
                                   " edits, expected at most " + std::to_string(kMostEdits));
    }
    const auto ground = groundOfEdits(world, registry_, all, *record, KeptGround::used, interruption);
    if (interruption.came()) return fail(kWorkFailed, "interrupted, " + consequence);
    if (const auto code = failWith(*world, consequence)) return *code;
    if (!ground) return fail(kWrongInput, consequence + ": " + ground.error().message);
    if (const auto code = append(file, *world, record->history, *added, **ground)) return *code;
    answer(file, all.size(), **ground, "applied", added->size());
    complainAbout(*world);
    return kSuccess;
  }

  /// After the edits that were there; nothing where all went well.
  std::optional<ExitCode> append(const std::filesystem::path& file, const World& world,
                                 const EditHistory& before, const std::vector<Edit>& added,
                                 const EditedGround& ground) const {
    if (!edits_.given()) {
      std::error_code ignored;  // what it means will be said of the file
      std::filesystem::create_directories(file.parent_path(), ignored);
    }
    const Result<std::unique_ptr<EditJournal>> journal = EditJournal::open(file, world.descriptionHash());
    if (!journal) return fail(kWrongInput, journal.error().message);
    if ((*journal)->found() != before) {
      return fail(kWorkFailed,
                  "another program has written " + inQuotes(file.string()) + " meanwhile, nothing was added");
    }
    (*journal)->append(added);
    const Result<void> written = (*journal)->flush();
    if (!written) return fail(kWorkFailed, (*journal)->abandon().message + "; nothing was added");
    if (auto checkpoint = ground.checkpoint()) (*journal)->keep(std::move(checkpoint));
    return std::nullopt;
  }

  ExitCode verify(const std::filesystem::path& file, const std::shared_ptr<const World>& world) const {
    const Interruption interruption;
    const Result<EditRecord> record = EditJournal::read(file, world->descriptionHash());
    if (!record) return fail(kWrongInput, record.error().message);
    if (record->damage) return fail(kWrongInput, record->damage->message);
    const auto ground =
        groundOfEdits(world, registry_, record->history.edits, *record, KeptGround::proved, interruption);
    if (interruption.came()) return fail(kWorkFailed, "interrupted, the edits were not all verified");
    if (const auto code = failWith(*world, "the edits were not all verified")) return *code;
    if (!ground) return fail(kWrongInput, inQuotes(file.string()) + ", " + ground.error().message);
    answer(file, record->history.edits.size(), **ground, "verified", record->history.edits.size());
    complainAbout(*world);
    return kSuccess;
  }

  /// The same edits, and what can be redone, in as little room as they need.
  ExitCode compact(const std::filesystem::path& file, const std::shared_ptr<const World>& world) const {
    const Interruption interruption;
    std::error_code ignored;  // what it means is said by who reads it
    if (!std::filesystem::exists(file, ignored)) {
      return fail(kWrongInput, EditJournal::read(file, world->descriptionHash()).error().message);
    }
    const auto journal = EditJournal::open(file, world->descriptionHash());
    if (!journal) return fail(kWrongInput, journal.error().message);
    const std::vector<Edit>& edits = (*journal)->found().edits;
    const std::uint64_t entries = (*journal)->record().entries;
    const std::uintmax_t bytes = size(file);
    const std::string consequence = "nothing was changed in " + inQuotes(file.string());
    const auto ground = groundOfEdits(world, registry_, edits, {}, KeptGround::used, interruption);
    if (interruption.came()) return fail(kWorkFailed, "interrupted, " + consequence);
    if (const auto code = failWith(*world, consequence)) return *code;
    if (!ground) return fail(kWrongInput, consequence + ": " + ground.error().message);
    if (const Result<void> compacted = (*journal)->compact((*ground)->checkpoint()); !compacted) {
      return fail(kWorkFailed, compacted.error().message + "; " + consequence);
    }
    const std::uint64_t left = (*journal)->record().entries;
    if (json_->count() > 0) {
      printJson({{"file", file.string()},
                 {"edits", edits.size()},
                 {"undone", (*journal)->found().undone.size()},
                 {"entries", {{"before", entries}, {"after", left}}},
                 {"bytes", {{"before", bytes}, {"after", size(file)}}},
                 {"hash", hashDigits((*ground)->hash())}});
    } else {
      std::cout << file.string() << ": " << edits.size() << " edits, " << entries << " entries became "
                << left << ", " << bytes << " bytes became " << size(file) << '\n';
    }
    complainAbout(*world);
    return kSuccess;
  }

  /// [bytes] With its log; 0 where it cannot be looked at.
  static std::uintmax_t size(const std::filesystem::path& file) {
    std::uintmax_t sum = 0;
    for (const char* ending : {"", "-wal"}) {
      std::error_code problem;
      const std::uintmax_t bytes = std::filesystem::file_size(file.string() + ending, problem);
      if (!problem) sum += bytes;
    }
    return sum;
  }

  void answer(const std::filesystem::path& file, std::size_t edits, const EditedGround& ground,
              const char* done, std::size_t count) const {
    const std::string hash = hashDigits(ground.hash());
    const EndedSurfaces ended = ground.ended();
    if (json_->count() > 0) {
      printJson(
          {{"file", file.string()},
           {done, count},
           {"edits", edits},
           {"hash", hash},
           {"ended", {{"surfaces", ended.surfaces}, {"error", ended.error}, {"absolute", ended.absolute}}}});
      return;
    }
    std::cout << file.string() << ": " << count << " edits " << done << ", " << edits
              << " in all, hash of the ground " << hash << '\n';
    if (ended.absolute > 0.0) {
      std::cout << ended.surfaces << (ended.surfaces == 1 ? " live surface" : " live surfaces")
                << " became samples: " << ended.error << " m^3 more by that, " << ended.absolute
                << " m^3 without signs\n";
    }
  }

  std::shared_ptr<const PluginRegistry> registry_;
  WorldOptions world_;
  EditOptions edits_;
  const CLI::Option* action_;
  const CLI::Option* text_;
  const CLI::Option* json_;
};

}  // namespace

std::unique_ptr<Command> makeEditsCommand(CLI::App& parent) {
  return std::make_unique<EditsCommand>(parent);
}

}  // namespace teren
