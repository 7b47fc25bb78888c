// The text form of edits, written, and read from hands that may be hostile.
#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <variant>

#include "teren/Edit.h"
#include "teren/Quote.h"

namespace teren {

namespace {

constexpr double kMostExact = 0x1p53;  // whole numbers up to here are doubles, all of them

bool isSpace(char c) {
  return c == ' ' || c == '\t';
}

bool isLowerOrDigit(char c) {
  return ('a' <= c && c <= 'z') || ('0' <= c && c <= '9');
}

/// As plugins' ids are.
bool isKind(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return isLowerOrDigit(c) || c == '-'; });
}

/// As parameters' names are.
bool isName(std::string_view text) {
  const auto isLetter = [](char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); };
  return !text.empty() && isLetter(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
    return isLetter(c) || isLowerOrDigit(c) || c == '-' || c == '_';
  });
}

/// Whether there is any but `allowed`.
bool hasControl(std::string_view text, char allowed = ' ') {
  return std::any_of(text.begin(), text.end(), [allowed](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return c != allowed && (byte < 0x20 || byte == 0x7F);
  });
}

std::optional<std::uint64_t> wholeText(std::string_view text) {
  std::uint64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (text.empty() || read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

/// A value without quotation marks: true, false, a number, or else a text.
ParameterValue bareValue(std::string_view text) {
  if (text == "true" || text == "false") return text == "true";
  std::int64_t whole = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, whole);
  if (!text.empty() && read.ec == std::errc() && read.ptr == end && text != "-0") return whole;
  const Result<double> number = parseNumber(text);
  if (!number) return std::string(text);
  const bool isWhole = std::floor(*number) == *number && std::fabs(*number) <= kMostExact;
  const bool isMinusZero = *number == 0.0 && std::signbit(*number);
  if (isWhole && !isMinusZero) return static_cast<std::int64_t>(*number);
  return *number;
}

/// Texts that read back as themselves without quotation marks.
bool isPlain(std::string_view text) {
  const auto breaks = [](char c) { return isSpace(c) || c == '"' || c == '#' || c == '\\'; };
  return !text.empty() && std::none_of(text.begin(), text.end(), breaks) &&
         std::holds_alternative<std::string>(bareValue(text));
}

std::string valueText(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return numberText(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  const std::string& text = *std::get_if<std::string>(&value);
  if (isPlain(text)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// The numbers of an edit, in the order of the text form.
struct Number {
  const char* name;
  double Edit::*member;
  double least, most;
};
constexpr double kMost = std::numeric_limits<double>::max();
constexpr std::array kNumbers = {
    Number{"X", &Edit::x, -kMost, kMost}, Number{"Y", &Edit::y, -kMost, kMost},
    Number{"Z", &Edit::z, -kMostEditMetres, kMostEditMetres},
    Number{"SIZE", &Edit::size, std::numeric_limits<double>::denorm_min(), kMostEditMetres},
    Number{"DEPTH", &Edit::depth, -kMostEditMetres, kMostEditMetres}};

std::string expectation(const Number& number) {
  if (number.most == kMost) return "a finite number of metres";
  const std::string least =
      number.least > 0.0 ? "above 0 and up to " : "from " + numberText(number.least) + " to ";
  return "a number of metres " + least + numberText(number.most);
}

Error mustBe(std::string_view name, std::string_view value, const std::string& what) {
  return Error{std::string(name) + " is " + inQuotes(value) + " but must be " + what};
}

Error badKind(std::string_view value) {
  return mustBe("KIND", value, "a deformer's id of lower-case letters, digits and '-'");
}

Error badSteps(std::string_view value) {
  return mustBe("STEPS", value, "a whole number from 0 to " + std::to_string(kMostEditSteps));
}

bool inRange(const Number& number, double value) {
  return number.least <= value && value <= number.most;  // false for NaN
}

Result<void> checkParameter(const Values::Entry& entry) {
  const auto& [name, value] = entry;
  if (!isName(name)) {
    return Error{inQuotes(name) +
                 " is no parameter's name, which begins with a letter and has letters, digits, '-' "
                 "and '_'"};
  }
  if (const auto* number = std::get_if<double>(&value); number != nullptr && !std::isfinite(*number)) {
    return mustBe(name, numberText(*number), "finite");
  }
  if (const auto* text = std::get_if<std::string>(&value); text != nullptr && hasControl(*text)) {
    return mustBe(name, *text, "without control characters");
  }
  return {};
}

Error tooLong() {
  return Error{"the edit is longer than " + std::to_string(kMostEditBytes) + " bytes"};
}

/// The words of a line, one after the other. A word of the form NAME="..." reaches to its last quotation
/// mark.
class WordReader {
 public:
  explicit WordReader(std::string_view line) : rest_(line) {}

  /// The next one, of what stands without quotation marks; empty at the end.
  std::string_view next() {
    skipSpaces();
    return bareWord();
  }

  /// The next NAME=VALUE; nothing at the end.
  Result<std::optional<Values::Entry>> nextAssignment() {
    skipSpaces();
    if (rest_.empty() || rest_.front() == '#') return std::optional<Values::Entry>();
    const auto stop =
        std::find_if(rest_.begin(), rest_.end(), [](char c) { return c == '=' || isSpace(c) || c == '#'; });
    const std::string_view name = take(static_cast<std::size_t>(stop - rest_.begin()));
    if (rest_.empty() || rest_.front() != '=')
      return Error{inQuotes(name) + " stands where NAME=VALUE was expected"};
    take(1);
    if (!rest_.empty() && rest_.front() == '"') {
      Result<std::string> text = quoted(name);
      if (!text) return text.error();
      return std::optional(Values::Entry(name, *std::move(text)));
    }
    const std::string_view value = bareWord();
    if (value.empty()) return Error{inQuotes(name) + " has no value after the '='"};
    if (value.find('"') != std::string_view::npos) {
      return Error{std::string(name) + " has a quotation mark in " + inQuotes(value) +
                   ", expected it at both ends or not at all"};
    }
    return std::optional(Values::Entry(name, bareValue(value)));
  }

 private:
  void skipSpaces() {
    while (!rest_.empty() && isSpace(rest_.front())) rest_.remove_prefix(1);
  }
  std::string_view take(std::size_t count) {
    const std::string_view word = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return word;
  }
  std::string_view bareWord() {
    const auto end = std::find_if(rest_.begin(), rest_.end(), [](char c) { return isSpace(c) || c == '#'; });
    return take(static_cast<std::size_t>(end - rest_.begin()));
  }
  Result<std::string> quoted(std::string_view name) {
    take(1);
    std::string text;
    while (!rest_.empty() && rest_.front() != '"') {
      if (rest_.front() == '\\') {
        take(1);
        if (rest_.empty() || (rest_.front() != '"' && rest_.front() != '\\')) {
          return Error{std::string(name) + " has a '\\' that neither '\"' nor '\\' follows"};
        }
      }
      text += take(1);
    }
    if (rest_.empty()) return Error{"the text of " + std::string(name) + " has no quotation mark at its end"};
    take(1);
    if (!rest_.empty() && !isSpace(rest_.front()) && rest_.front() != '#') {
      return Error{"something follows the text of " + std::string(name) + " without a space"};
    }
    return text;
  }

  std::string_view rest_;
};

/// Adds the parameters that stand at the end of a line.
Result<void> readParameters(WordReader& words, Edit& edit) {
  for (;;) {
    Result<std::optional<Values::Entry>> entry = words.nextAssignment();
    if (!entry) return entry.error();
    if (!entry->has_value()) return {};
    edit.parameters.push_back(*std::move(*entry));
  }
}

/// Everything but what checkEdit finds.
Result<Edit> readEdit(std::string_view line) {
  WordReader words(line);
  if (const std::string_view command = words.next(); command != "stamp") {
    return Error{"the line begins with " + inQuotes(command) +
                 ", expected stamp KIND X Y Z SIZE DEPTH SEED STEPS [NAME=VALUE]..."};
  }
  Edit edit;
  edit.kind = words.next();
  if (!isKind(edit.kind)) return badKind(edit.kind);
  for (const Number& number : kNumbers) {
    const std::string_view word = words.next();
    const Result<double> value = parseNumber(word);
    if (!value || !inRange(number, *value)) return mustBe(number.name, word, expectation(number));
    edit.*number.member = *value;
  }
  const std::string_view seedWord = words.next();
  const std::optional<std::uint64_t> seed = wholeText(seedWord);
  if (!seed) return mustBe("SEED", seedWord, "a whole number from 0 to 18446744073709551615");
  edit.seed = *seed;
  const std::string_view stepsWord = words.next();
  const std::optional<std::uint64_t> steps = wholeText(stepsWord);
  if (!steps || *steps > kMostEditSteps) return badSteps(stepsWord);
  edit.steps = *steps;
  if (const Result<void> read = readParameters(words, edit); !read) return read.error();
  return edit;
}

/// Whether there is nothing on the line but spaces and a comment.
bool isBlank(std::string_view line) {
  const auto first = std::find_if_not(line.begin(), line.end(), isSpace);
  return first == line.end() || *first == '#';
}

}  // namespace

Result<void> checkEdit(const Edit& edit) {
  if (!isKind(edit.kind)) return badKind(edit.kind);
  for (const Number& number : kNumbers) {
    const double value = edit.*number.member;
    if (!inRange(number, value)) return mustBe(number.name, numberText(value), expectation(number));
  }
  if (edit.steps > kMostEditSteps) return badSteps(std::to_string(edit.steps));
  for (const Values::Entry& entry : edit.parameters) {
    if (const Result<void> checked = checkParameter(entry); !checked) return checked;
  }
  std::vector<std::string_view> names;
  for (const Values::Entry& entry : edit.parameters) names.push_back(entry.first);
  std::sort(names.begin(), names.end());
  if (const auto twice = std::adjacent_find(names.begin(), names.end()); twice != names.end()) {
    return Error{"the parameter " + inQuotes(*twice) + " is there twice, expected each name once"};
  }
  if (editText(edit).size() > kMostEditBytes) return tooLong();
  return {};
}

std::string editText(const Edit& edit) {
  std::string line = "stamp " + edit.kind;
  for (const Number& number : kNumbers) (line += ' ') += numberText(edit.*number.member);
  line += ' ' + std::to_string(edit.seed) + ' ' + std::to_string(edit.steps);
  for (const auto& [name, value] : edit.parameters) {
    assert(isName(name));
    line += ' ' + name + '=' + valueText(value);
  }
  return line;
}

Result<Edit> parseEdit(std::string_view line) {
  if (line.size() > kMostEditBytes) return tooLong();
  if (hasControl(line, '\t')) return Error{"the line " + inQuotes(line) + " has control characters"};
  Result<Edit> edit = readEdit(line);
  if (!edit) return edit;
  if (const Result<void> checked = checkEdit(*edit); !checked) return checked.error();
  return edit;
}

Result<std::vector<Edit>> parseEdits(std::string_view text, std::string_view source) {
  const std::string name = shortened(source);
  if (text.size() > kMostEditListBytes)
    return Error{name + " is larger than 1 GiB, which no list of edits is"};
  std::vector<Edit> edits;
  std::size_t number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    begin = end + 1;
    ++number;
    if (isBlank(line)) continue;
    const auto refused = [&](const std::string& sentence) {
      return Error{name + ", line " + std::to_string(number) + ": " + sentence};
    };
    if (edits.size() == kMostEdits)
      return refused("there are more than " + std::to_string(kMostEdits) + " edits");
    Result<Edit> edit = parseEdit(line);
    if (!edit) return refused(edit.error().message);
    edits.push_back(*std::move(edit));
  }
  return edits;
}

}  // namespace teren
