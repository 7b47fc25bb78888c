#include "apps/sandbox/SandScript.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "teren/Quote.h"

#include "apps/files/InputFile.h"
#include "apps/options/CommandLine.h"
#include "apps/sandbox/SandTool.h"

namespace teren {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;
constexpr std::size_t kMostLineBytes = 16384;
constexpr std::size_t kMostCommands = 100'000;
constexpr std::int64_t kMostBeats = 1'000'000;
constexpr std::int64_t kBeatsToSettle = 100'000;
constexpr double kFarthest = 1'000.0;   // [m] the largest box's side
constexpr double kDragSpeed = 0.5;      // [m/s]
constexpr double kMostSpeed = 1'000.0;  // [m/s]

using Words = std::vector<std::string>;  // what follows a command's name
using What = decltype(SandCommand::what);

/// The words of a line.
Result<Words> wordsOf(std::string_view line) {
  Words words;
  bool inside = false, quoted = false;
  for (const char c : line) {
    if (static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\r') {
      return Error{"there is a control character, expected a command as plain text"};
    }
    const bool space = c == ' ' || c == '\t' || c == '\r';
    if (!quoted && c == '#') break;
    if (!quoted && space) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == '"') {
      quoted = !quoted;
    } else {
      words.back() += c;
    }
  }
  if (quoted) return Error{"a quotation mark is not closed"};
  return words;
}

/// "name=value ..." by a table; names in `own` are not the table's.
Result<Values> assignments(std::span<const Parameter> table, std::vector<Values::Entry> entries,
                           std::span<const std::string> words, const std::string& command) {
  for (const std::string& word : words) {
    Result<Values::Entry> entry = parseAssignment(table, word);
    if (!entry) return entry.error();
    entries.push_back(*std::move(entry));
  }
  return Values::check(table, entries, command);
}

Result<What> readSand(const Words& words) {
  std::vector<Values::Entry> entries;
  std::span<const std::string> rest = words;
  if (!rest.empty() && rest.front().find('=') == std::string::npos) {
    const Result<std::int64_t> vertices = wholeArgument("vertices", rest.front(), 4, 4'000'000);
    if (!vertices) return vertices.error();
    entries.emplace_back("vertices", *vertices);
    rest = rest.subspan(1);
  }
  const Result<Values> values = assignments(SandGround::parameters(), std::move(entries), rest, "sand");
  if (!values) return values.error();
  return What(NewSand{SandGround::from(*values)});
}

Result<What> readTool(const Words& words) {
  if (words.empty()) return Error{"tool names no tool, expected round, square, rake, wedge, ball or polygon"};
  std::vector<Values::Entry> entries = {{"tool", words.front()}};
  Words rest(words.begin() + 1, words.end());
  const auto file =
      std::find_if(rest.begin(), rest.end(), [](const std::string& w) { return w.starts_with("file="); });
  if (file != rest.end()) {
    Result<std::string> outline = readOutline(file->substr(5));
    if (!outline) return outline.error();
    entries.emplace_back("outline", *std::move(outline));
    rest.erase(file);
  }
  Result<Values> values = assignments(SandTool::parameters(), std::move(entries), rest, "tool");
  if (!values) return values.error();
  if (const Result<ToolShape> shape = SandTool::shape(*values); !shape) return shape.error();
  return What(TakeTool{*std::move(values)});
}

Result<double> oneNumber(const Words& words, const char* name, double min, double max) {
  if (words.size() != 1) {
    return Error{std::string(name) + " has " + std::to_string(words.size()) +
                 " values, expected one number from " + numberText(min) + " to " + numberText(max)};
  }
  return numberArgument(name, words.front(), min, max);
}

Result<What> readRepose(const Words& words) {
  const Result<double> angle = oneNumber(words, "repose", 1.0, 60.0);
  if (!angle) return angle.error();
  return What(SetRepose{*angle});
}

Result<What> readMoisture(const Words& words) {
  const Result<double> moisture = oneNumber(words, "moisture", 0.0, 1.0);
  if (!moisture) return moisture.error();
  return What(SetMoisture{*moisture});
}

Result<bool> onOrOff(const Words& words, const char* name) {
  if (words.size() == 1 && (words.front() == "on" || words.front() == "off")) return words.front() == "on";
  return Error{std::string(name) + " must be followed by on or off" +
               (words.empty() ? "" : ", not by " + inQuotes(words.front()))};
}

Result<What> readSlides(const Words& words) {
  const Result<bool> on = onOrOff(words, "slides");
  if (!on) return on.error();
  return What(SetSlides{*on});
}

Result<What> readWireframe(const Words& words) {
  const Result<bool> on = onOrOff(words, "wireframe");
  if (!on) return on.error();
  return What(SetWireframe{*on});
}

/// X Y or X Y Z.
Result<ToolPlace> readPlace(std::span<const std::string> words, const char* command) {
  if (words.size() != 2 && words.size() != 3) {
    return Error{std::string(command) + " has a place of " + std::to_string(words.size()) +
                 " numbers, expected X Y or X Y Z"};
  }
  const Result<double> x = numberArgument("X", words[0], 0.0, kFarthest);
  if (!x) return x.error();
  const Result<double> y = numberArgument("Y", words[1], 0.0, kFarthest);
  if (!y) return y.error();
  ToolPlace place{*x, *y, std::nullopt};
  if (words.size() == 3) {
    const Result<double> z = numberArgument("Z", words[2], -kHighestTool, kHighestTool);
    if (!z) return z.error();
    place.height = *z;
  }
  return place;
}

Result<What> readStamp(const Words& words) {
  const Result<ToolPlace> place = readPlace(words, "stamp");
  if (!place) return place.error();
  return What(Stroke{{*place}, 0.0});
}

Result<What> readDrag(const Words& words) {
  Stroke stroke{{}, kDragSpeed};
  std::span<const std::string> rest = words;
  if (!rest.empty() && rest.back().starts_with("speed=")) {
    const Result<double> speed = numberArgument("speed", rest.back().substr(6), 0.0, kMostSpeed);
    if (!speed) return speed.error();
    stroke.speed = *speed;
    rest = rest.first(rest.size() - 1);
  }
  for (bool more = true; more;) {
    const auto to = std::find(rest.begin(), rest.end(), "to");
    const auto length = static_cast<std::size_t>(to - rest.begin());
    const Result<ToolPlace> place = readPlace(rest.first(length), "drag");
    if (!place) return place.error();
    stroke.places.push_back(*place);
    more = to != rest.end();
    if (more) rest = rest.subspan(length + 1);
  }
  if (stroke.places.size() < 2) return Error{"drag names one place, expected X Y to X Y"};
  const auto hasHeight = [](const ToolPlace& place) { return place.height.has_value(); };
  const auto heights = std::count_if(stroke.places.begin(), stroke.places.end(), hasHeight);
  if (heights != 0 && heights != static_cast<std::ptrdiff_t>(stroke.places.size())) {
    return Error{"drag gives a height Z at some of its places, expected one at each or at none"};
  }
  return What(std::move(stroke));
}

Result<std::uint64_t> readCount(const Words& words, const char* name, std::optional<std::int64_t> otherwise) {
  if (words.empty() && otherwise) return static_cast<std::uint64_t>(*otherwise);
  if (words.size() != 1) return Error{std::string(name) + " must be followed by one number of beats"};
  const Result<std::int64_t> count = wholeArgument(name, words.front(), 0, kMostBeats);
  if (!count) return count.error();
  return static_cast<std::uint64_t>(*count);
}

Result<What> readSettle(const Words& words) {
  const Result<std::uint64_t> beats = readCount(words, "settle", kBeatsToSettle);
  if (!beats) return beats.error();
  return What(RunBeats{*beats, true});
}

Result<What> readBeats(const Words& words) {
  const Result<std::uint64_t> beats = readCount(words, "beats", std::nullopt);
  if (!beats) return beats.error();
  return What(RunBeats{*beats, false});
}

template <Deed deed>
Result<What> readDeed(const Words& words) {
  if (words.empty()) return What(deed);
  return Error{"there is " + inQuotes(words.front()) + " after a command that takes nothing"};
}

template <UseFile::Use use>
Result<What> readFileName(const Words& words) {
  if (words.size() == 1 && !words.front().empty()) return What(UseFile{use, words.front()});
  return Error{"there are " + std::to_string(words.size()) +
               " words where one file was expected; a name with spaces goes between quotation marks"};
}

Result<What> readCamera(const Words& words) {
  Result<Values> values = assignments(cameraParameters(), {}, words, "camera");
  if (!values) return values.error();
  return What(SetCamera{*std::move(values)});
}

/// One command: its name, how its line looks, what it does, and who reads it.
struct Entry {
  std::string_view name, form, doc;
  Result<What> (*read)(const Words&);
};

constexpr std::array kEntries = {
    Entry{"sand", "sand [VERTICES] [size=M] [depth=M] [roughness=M] [seed=N]", "new sand", readSand},
    Entry{"tool",
          "tool round|square|rake|wedge|ball|polygon [size=M] [depth=M] [teeth=N] [corners=N] [outline=\"X,Y "
          "...\"] "
          "[file=FILE]",
          "another tool; a polygon's points are in sizes from its middle", readTool},
    Entry{"repose", "repose DEGREES", "the angle at which dry sand lies, 1 to 60", readRepose},
    Entry{"moisture", "moisture PART", "0 (dry) to 1 (damp)", readMoisture},
    Entry{"slides", "slides on|off", "whether sand slides", readSlides},
    Entry{"stamp", "stamp X Y [Z]", "presses the tool in, from the ground or the height Z", readStamp},
    Entry{"drag", "drag X Y [Z] to X Y [Z] [to ...] [speed=M/S]", "drags the tool from place to place",
          readDrag},
    Entry{"settle", "settle [BEATS]", "lets the sand come to rest, which must take no more beats",
          readSettle},
    Entry{"beats", "beats N", "lets so many beats pass, fewer where all is at rest", readBeats},
    Entry{"undo", "undo", "takes back the last action", readDeed<Deed::undo>},
    Entry{"redo", "redo", "does it again", readDeed<Deed::redo>},
    Entry{"save", "save FILE", "the whole state", readFileName<UseFile::Use::save>},
    Entry{"load", "load FILE", "what was saved", readFileName<UseFile::Use::load>},
    Entry{"export", "export FILE", "the surface as an OBJ file", readFileName<UseFile::Use::exportObj>},
    Entry{"wireframe", "wireframe on|off", "edges instead of a surface, constrained ones red", readWireframe},
    Entry{"camera", "camera [turn=DEGREES] [tilt=DEGREES] [distance=M] [x=M] [y=M] [z=M]", "another view",
          readCamera},
    Entry{"screenshot", "screenshot FILE", "the picture as a PNG file",
          readFileName<UseFile::Use::screenshot>},
    Entry{"hash", "hash", "prints a hash of the surface", readDeed<Deed::printHash>},
    Entry{"counts", "counts", "prints how many vertices, triangles and constrained edges there are",
          readDeed<Deed::printCounts>},
    Entry{"quit", "quit", "ends the program", readDeed<Deed::quit>},
};

Result<What> readCommand(const Words& words) {
  const auto* entry = std::find_if(kEntries.begin(), kEntries.end(),
                                   [&](const Entry& one) { return one.name == words.front(); });
  if (entry == kEntries.end()) {
    std::string names;
    for (const Entry& one : kEntries) names += (names.empty() ? "" : ", ") + std::string(one.name);
    return Error{inQuotes(words.front()) + " is no command, expected one of " + names};
  }
  return entry->read(Words(words.begin() + 1, words.end()));
}

}  // namespace

std::span<const Parameter> cameraParameters() noexcept {
  static constexpr Parameter table[] = {
      Parameter::real("turn", -30.0, -3600.0, 3600.0, "degree",
                      "the way the eye looks, from north to the west"),
      Parameter::real("tilt", 40.0, 1.0, 90.0, "degree", "how steeply it looks down"),
      Parameter::real("distance", 0.0, 0.0, 1e5, "m", "of the eye; 0: all is in view"),
      Parameter::real("x", 0.0, -1000.0, 1000.0, "m", "east of the middle, the place looked at"),
      Parameter::real("y", 0.0, -1000.0, 1000.0, "m", "north of the middle"),
      Parameter::real("z", 0.0, -16000.0, 16000.0, "m", "above the middle"),
  };
  return table;
}

Result<SandScript> SandScript::fromFile(const std::string& file) {
  const Result<std::string> text = readFile(file, kMostBytes);
  if (!text) return Error{text.error().message + ", expected a script"};
  return fromText(*text, file);
}

Result<SandScript> SandScript::fromText(std::string_view text, const std::string& source) {
  SandScript script(shortened(source));
  int number = 0;
  std::size_t outlines = 0;  // [bytes]
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    if (line.size() > kMostLineBytes) {
      return script.errorAt(number, "the line is longer than " + std::to_string(kMostLineBytes) + " bytes");
    }
    const Result<Words> words = wordsOf(line);
    if (!words) return script.errorAt(number, words.error().message);
    if (words->empty()) continue;
    if (script.commands_.size() == kMostCommands) {
      return script.errorAt(number, "there are more than " + std::to_string(kMostCommands) + " commands");
    }
    Result<What> what = readCommand(*words);
    if (!what) return script.errorAt(number, what.error().message);
    if (const auto* taken = std::get_if<TakeTool>(&*what)) outlines += taken->values.text("outline").size();
    if (outlines > kMostBytes) {
      return script.errorAt(
          number, "the outlines of all tools are longer than " + std::to_string(kMostBytes) + " bytes");
    }
    script.commands_.push_back({number, *std::move(what)});
  }
  return script;
}

Error SandScript::errorAt(int line, const std::string& sentence) const {
  return Error{source_ + ", line " + std::to_string(line) + ": " + sentence};
}

Error SandScript::errorAt(const SandCommand& command, const std::string& sentence) const {
  return errorAt(command.line, sentence);
}

bool SandScript::needsPicture() const noexcept {
  return std::any_of(commands_.begin(), commands_.end(), [](const SandCommand& command) {
    const auto* use = std::get_if<UseFile>(&command.what);
    return use != nullptr && use->use == UseFile::Use::screenshot;
  });
}

std::string SandScript::help() {
  std::string text;
  for (const Entry& entry : kEntries) {
    text += "  " + std::string(entry.form) + "\n      " + std::string(entry.doc) + "\n";
  }
  return text;
}

}  // namespace teren
