// Edits: what was done to a landscape, press by press. A list of them is all it takes to do the same again
// anywhere, to the same bits (law 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "teren/Parameter.h"
#include "teren/Result.h"

namespace teren {

/// One press of a deformer's tool (Deformer.h), and how long what was pressed before had settled until then.
struct Edit {
  std::string kind;         ///< the deformer's plugin id
  double x = 0.0, y = 0.0;  ///< [m] from the world's zero; the place is these two numbers, exactly
  double z = 0.0;           ///< [m] at which the tool was held; tools that press from the ground ignore it
  double size = 1.0;        ///< [m] radius, or half the width; > 0, at most kMostEditMetres
  double depth = 0.0;       ///< [m] downwards where positive; within +-kMostEditMetres, as z is
  std::uint64_t seed = 0;   ///< of what is random in it
  /// Logical steps that everything in motion does between the edit before and this one, fewer where it comes
  /// to rest; 0 ... kMostEditSteps.
  std::uint64_t steps = 0;
  /// Of the deformer's table; what is not named has its default. Each name once.
  std::vector<Values::Entry> parameters;

  friend bool operator==(const Edit&, const Edit&) = default;
};

/// The edits that count, in order, and those that were taken back and could count again, the latest last.
struct EditHistory {
  std::vector<Edit> edits, undone;

  /// What was taken back before stays so for good.
  void press(Edit edit) {
    edits.push_back(std::move(edit));
    undone.clear();
  }
  /// The latest edit counts no more; false where there is none.
  bool undo() { return move(edits, undone); }
  /// The latest that was taken back counts again; false where there is none.
  bool redo() { return move(undone, edits); }

  friend bool operator==(const EditHistory&, const EditHistory&) = default;

 private:
  static bool move(std::vector<Edit>& from, std::vector<Edit>& to) {
    if (from.empty()) return false;
    to.push_back(std::move(from.back()));
    from.pop_back();
    return true;
  }
};

inline constexpr double kMostEditMetres = 1e6;
/// Whatever has not come to rest after so many logical steps never will.
inline constexpr std::uint64_t kMostEditSteps = 1'000'000;
inline constexpr std::size_t kMostEditBytes = std::size_t{1} << 16;      ///< of one edit's text
inline constexpr std::size_t kMostEdits = 10'000'000;                    ///< of one list
inline constexpr std::size_t kMostEditListBytes = std::size_t{1} << 30;  ///< of a list's text

/// What the text form can say, and a deformer can be asked: everything in its range and finite, ids and names
/// well-formed, no name twice, no control character, the text within kMostEditBytes. Whether a deformer takes
/// the parameters is for EditedGround to say.
Result<void> checkEdit(const Edit& edit);

/// The text form, one line without a line break:
///   stamp KIND X Y Z SIZE DEPTH SEED STEPS [NAME=VALUE]...
/// Numbers are the shortest that read back the same. A VALUE is a number, true or false, or a text: between
/// quotation marks where it is not plainly one word, with \" and \\ for what would end it. `edit` has passed
/// checkEdit (assert).
std::string editText(const Edit& edit);

/// Reads one line of the text form and checks it. parseEdit(editText(edit)) is the edit, but that a
/// whole-numbered real within +-2^53 becomes the same integer (to a parameter table both are one) and -0 in
/// them stays -0. Words are parted by spaces and tabs. Errors name the field, the value and what was
/// expected.
Result<Edit> parseEdit(std::string_view line);

/// Reads a list of edits, a line each; empty lines and what follows a '#' outside quotation marks are left
/// out. `source` names the text in messages: "SOURCE, line N: ...". O(bytes); a million lines take about a
/// second.
Result<std::vector<Edit>> parseEdits(std::string_view text, std::string_view source);

}  // namespace teren
