// World files: texts that are no JSON, JSON that is no world, and worlds that cannot be - through the
// library, which names "w.json", and through the program, which names the file and leaves none of its own.
#include <filesystem>
#include <limits>
#include <string>
#include <sys/stat.h>
#include <vector>

#include <gtest/gtest.h>

#include "teren/World.h"

#include "tests/doors/Refusal.h"
#include "tests/doors/Registry.h"
#include "tests/engine/plugin/ScratchFolder.h"

namespace teren {
namespace {

struct Hostile {
  std::string text;
  Needles needles;
};

std::string layer(const std::string& members) {
  return R"({"layers": [{"generator": "fault", )" + members + "}]}";
}

std::string deep(const std::string& open, const std::string& close, int depth) {
  std::string text;
  for (int k = 0; k < depth; ++k) text += open;
  for (int k = 0; k < depth; ++k) text += close;
  return text;
}

std::vector<Hostile> hostileTexts() {
  const std::string one = R"("layers": [{"generator": "fault"}])";
  return {
      // Not JSON.
      {"", {"is not JSON"}},
      {"\n\n", {"is not JSON"}},
      {"{" + one, {"is not JSON", "byte"}},
      {R"({"layers": [{"generator": "fau)", {"is not JSON"}},
      {"{" + one + "} x", {"is not JSON", "byte"}},
      {"{'layers': []}", {"is not JSON", "byte 2"}},
      {R"({"pitch": NaN, )" + one + "}", {"is not JSON", "byte"}},
      {R"({"pitch": Infinity, )" + one + "}", {"is not JSON"}},
      {R"({"pitch": 1e999, )" + one + "}", {"'1e999'", "\"pitch\""}},
      {R"({"pitch": -1e999, )" + one + "}", {"-1e999"}},
      {layer(R"("parameters": {"deviation": 1e400})"), {"1e400"}},
      {"{\"seed\": 1, \"layers\": [{\"generator\": \"\xff\"}]}", {"is not JSON"}},
      {std::string("{\"seed\": 1\0}", 12), {"is not JSON"}},
      // Not a world.
      {"null", {"object"}},
      {"[1]", {"object"}},
      {"\"world\"", {"object"}},
      {"{}", {"layers", "missing"}},
      {R"({"layers": []})", {"layers", "[]", "at least one"}},
      {R"({"layers": {}})", {"layers", "{}"}},
      {R"({"layers": "fault"})", {"layers", "\"fault\""}},
      {R"({"layers": [7]})", {"layers[0]", "object"}},
      {R"({"layers": [{"generator": "fault"}, null]})", {"layers[1]", "object"}},
      {R"({"layers": [{}]})", {"layers[0]", "generator"}},
      // Unknown keys.
      {R"({"sed": 1, )" + one + "}", {"sed", "known key", "seed"}},
      {R"({"Seed": 1, )" + one + "}", {"Seed", "known key"}},
      {layer(R"("hurst": 1)"), {"layers[0].hurst", "known key", "parameters"}},
      {layer(R"("filters": [{"filter": "band", "k": 1}])"), {"layers[0].filters[0].k", "known key"}},
      {R"({"a\nb": 1, )" + one + "}", {"a?b", "known key"}},
      {"{\"" + std::string(100'000, 'k') + "\": 1, " + one + "}", {"kkk...", "known key"}},
      // Wrong types and values.
      {R"({"seed": -1, )" + one + "}", {"seed", "-1"}},
      {R"({"seed": 1.5, )" + one + "}", {"seed", "1.5"}},
      {R"({"seed": 1e3, )" + one + "}", {"seed", "1000"}},
      {R"({"seed": 18446744073709551616, )" + one + "}", {"seed", "1.8446744073709552e+19"}},
      {R"({"seed": "42", )" + one + "}", {"seed", "\"42\""}},
      {R"({"seed": null, )" + one + "}", {"seed", "null"}},
      {R"({"pitch": "64", )" + one + "}", {"pitch", "\"64\"", "number"}},
      {R"({"pitch": [64], )" + one + "}", {"pitch", "[64]"}},
      {R"({"samples": 65.5, )" + one + "}", {"samples", "65.5", "whole number"}},
      {R"({"samples": -65, )" + one + "}", {"samples", "-65"}},
      {R"({"samples": 4294967361, )" + one + "}", {"samples", "4294967361"}},
      {R"({"samples": true, )" + one + "}", {"samples", "true"}},
      {R"({"blend": "cubic", )" + one + "}", {"blend", "\"cubic\"", "linear", "smooth"}},
      {R"({"blend": 1, )" + one + "}", {"blend", "1", "linear"}},
      {R"({"preserveVariance": 1, )" + one + "}", {"preserveVariance", "1", "true or false"}},
      {R"({"preserveVariance": "true", )" + one + "}", {"preserveVariance", "\"true\""}},
      {layer(R"("pitch": {})"), {"layers[0].pitch", "{}"}},
      {layer(R"("samples": "9")"), {"layers[0].samples", "\"9\""}},
      {layer(R"("blend": null)"), {"layers[0].blend", "null"}},
      {layer(R"("name": "")"), {"layers[0].name", "\"\"", "1 to 200"}},
      {layer(R"("name": 7)"), {"layers[0].name", "7", "text"}},
      {layer(R"("name": ")" + std::string(201, 'n') + "\""), {"layers[0].name", "nnn...", "1 to 200"}},
      {R"({"layers": [{"generator": ["fault"]}]})", {"layers[0].generator", "text"}},
      {layer(R"("parameters": [1, 2])"), {"layers[0].parameters", "[1,2]", "object"}},
      {layer(R"("parameters": {"faults": null})"), {"layers[0].parameters.faults"}},
      {layer(R"("parameters": {"faults": [150]})"), {"layers[0].parameters.faults"}},
      {layer(R"("filters": {"filter": "band"})"), {"layers[0].filters", "list"}},
      {layer(R"("filters": ["band"])"), {"layers[0].filters[0]", "object"}},
      {layer(R"("filters": [{"filter": "band"}, {}])"), {"layers[0].filters[1]", "filter"}},
      {layer(R"("filters": [{"filter": "band", "parameters": 3}])"),
       {"layers[0].filters[0].parameters", "3"}},
      // Values whose text is long, has line breaks or is cut in the middle of a character.
      {R"({"blend": ")" + std::string(39, 'x') + "äöü\", " + one + "}", {"blend", "xxx", "..."}},
      {R"({"blend": "a\u0085b\u2028c", )" + one + "}", {"blend"}},
      {R"({"pitch": ")" + std::string(1'000'000, 'x') + "\", " + one + "}", {"pitch", "xxx..."}},
      {layer(R"("parameters": {"line\nbreak": null})"), {"layers[0].parameters.line?break"}},
      // Keys given twice.
      {R"({"seed": 1, "seed": 2, )" + one + "}", {"\"seed\"", "twice"}},
      {layer(R"("generator": "noise")"), {"\"generator\"", "twice"}},
      {layer(R"("parameters": {"faults": 1, "faults": 2})"), {"\"faults\"", "twice"}},
      {layer(R"("parameters": {"a\nb": 1, "a\nb": 2})"), {"\"a?b\"", "twice"}},
      // Nesting.
      {deep("[", "]", 40), {"nested", "32"}},
      {deep(R"({"a":)", "}", 40), {}},
      {deep("[", "]", 1'000'000), {"nested", "32"}},
      {std::string(15'000'000, '['), {"w.json"}},
      {R"({"x": )" + deep("[", "]", 40) + ", " + one + "}", {"nested", "32"}},
  };
}

/// JSON descriptions of worlds that cannot be made.
std::vector<Hostile> impossibleWorlds() {
  const auto world = [](const std::string& members) {
    return "{" + members + R"(, "layers": [{"generator": "fault"}]})";
  };
  const auto parameters = [](const std::string& members) {
    return layer(R"("parameters": {)" + members + "}");
  };
  const auto filter = [](const std::string& members) { return layer(R"("filters": [{)" + members + "}]"); };
  const auto hostile = [](const std::string& way) {
    return R"({"layers": [{"name": "hills", "generator": "hostile", "parameters": {"way": ")" + way +
           "\"}}]}";
  };
  const auto liar = [&](const std::string& way) {
    return filter(R"("filter": "liar", "parameters": {"way": ")" + way + "\"}");
  };
  std::vector<Hostile> cases = {
      // Even or tiny samples.
      {world(R"("samples": 64)"), {"samples is 64", "2^k + 1 from 5 to 1025"}},
      {world(R"("samples": 66)"), {"samples is 66", "2^k + 1"}},
      {world(R"("samples": 4)"), {"samples is 4", "5"}},
      {world(R"("samples": 3)"), {"samples is 3", "5"}},
      {world(R"("samples": 1)"), {"samples is 1", "5"}},
      {world(R"("samples": 0)"), {"samples is 0", "5"}},
      {world(R"("samples": 2049)"), {"samples is 2049", "1025"}},
      {world(R"("samples": 1000000000)"), {"samples is 1000000000", "1025"}},
      {layer(R"("samples": 64)"), {"layer \"fault\"", "samples is 64", "2^k + 1 from 3 to 2049"}},
      {layer(R"("samples": 2)"), {"layer \"fault\"", "samples is 2", "3"}},
      {layer(R"("samples": 4097)"), {"layer \"fault\"", "samples is 4097", "2049"}},
      // Pitches.
      {world(R"("pitch": 0)"), {"pitch is 0 m", "0.001 to 1e6"}},
      {world(R"("pitch": -64)"), {"pitch is -64 m", "0.001"}},
      {world(R"("pitch": 1e300)"), {"pitch is 1e+300 m", "1e6"}},
      {world(R"("pitch": 1e-320)"), {"pitch is 1e-320 m", "0.001"}},
      {layer(R"("pitch": 96)"), {"layer \"fault\"", "pitch is 96 m", "64 m times 2^m"}},
      {layer(R"("pitch": 1e300)"), {"layer \"fault\"", "pitch is 1e+300 m", "64 m times 2^m"}},
      // Plugins that are not there, or are of another kind.
      {R"({"layers": [{"generator": "fualt"}]})",
       {"layer \"fualt\"", "no generator has the id \"fualt\"", "fault"}},
      {R"({"layers": [{"generator": "band"}]})", {"layer \"band\"", "\"band\" is a filter"}},
      {R"({"layers": [{"generator": "../../fault"}]})", {"\"../../fault\""}},
      {filter(R"("filter": "bend")"), {"layer \"fault\"", "no filter has the id \"bend\"", "band"}},
      {filter(R"("filter": "fault")"), {"layer \"fault\"", "\"fault\" is a generator"}},
      // Parameters.
      {parameters(R"("hurst": 1)"), {"layer \"fault\"", "no parameter \"hurst\"", "faults"}},
      {parameters(R"("faults": 42.5)"), {"layer \"fault\"", "\"faults\"", "42.5", "whole number from 1"}},
      {parameters(R"("faults": -1)"), {"\"faults\"", "-1"}},
      {parameters(R"("faults": 0)"), {"\"faults\"", "is 0 "}},
      {parameters(R"("faults": 18446744073709551616)"), {"\"faults\"", "1844674407370955161"}},
      {parameters(R"("faults": 18446744073709551615)"), {"\"faults\"", "1844674407370955161"}},
      {parameters(R"("faults": 9223372036854775807)"), {"\"faults\"", "9223372036854775807"}},
      {parameters(R"("faults": 1e308)"), {"\"faults\"", "1e+308"}},
      {parameters(R"("faults": "150")"), {"\"faults\"", "\"150\"", "whole number"}},
      {parameters(R"("faults": true)"), {"\"faults\"", "true", "whole number"}},
      {parameters(R"("deviation": -1e-300)"), {"\"deviation\"", "-1e-300", "number from 0"}},
      {parameters(R"("deviation": 1e300)"), {"\"deviation\"", "1e+300", "m"}},
      {parameters(R"("deviation": "a\nb")"), {"\"deviation\"", "\"a?b\""}},
      {filter(R"("filter": "band", "parameters": {"k": 2})"), {"layer \"fault\"", "\"k\" of band", "is 2 "}},
      {filter(R"("filter": "matrix", "parameters": {"matrix": "0 -1 0; -1 4 -1; 0 -1 0"})"),
       {"layer \"fault\"", "\"matrix\"", "sum to 0"}},
      {filter(R"("filter": "matrix", "parameters": {"matrix": "1 2; 3"})"),
       {"layer \"fault\"", "\"matrix\"", "row 2 of its matrix has 1 elements, expected 2"}},
      {filter(R"("filter": "matrix", "parameters": {"matrix": 3})"),
       {"layer \"fault\"", "\"matrix\" of matrix", "is 3 ", "a text"}},
      // Names.
      {R"({"layers": [{"name": "a\nb", "generator": "fault"}, {"name": "a\nb", "generator": "fault"}]})",
       {"two layers", "\"a?b\""}},
      // Generators that throw when they are made.
      {R"({"layers": [{"generator": "throwing"}]})", {"layer \"throwing\"", "no ground today"}},
      {R"({"layers": [{"generator": "throwing", "parameters": {"height": 2}}]})", {"without saying why"}},
      {R"({"layers": [{"generator": "throwing", "parameters": {"height": 3}}]})", {"made nothing"}},
      {R"({"layers": [{"generator": "throwing", "parameters": {"height": 4}}]})", {"without a text"}},
      // Promises that make no sense.
      {hostile("throws"), {"layer \"hills\"", "\"hostile\" threw \"two?lines\"", "range"}},
      {hostile("throws-int"), {"layer \"hills\"", "\"hostile\" threw", "range"}},
      {hostile("nan"), {"layer \"hills\"", "\"hostile\"", "mean nan"}},
      {hostile("infinite"), {"\"hostile\"", "max inf"}},
      {hostile("huge"), {"\"hostile\"", "mean 1e+300"}},
      {hostile("reversed"), {"\"hostile\"", "min 1, max -1"}},
      {hostile("negative"), {"\"hostile\"", "deviation -1"}},
      {liar("throws"), {"layer \"fault\"", "\"liar\" threw \"two?lines\"", "range"}},
      {liar("nan"), {"\"liar\"", "mean nan"}},
      {liar("reversed"), {"\"liar\"", "min 1, max -1"}},
  };
  return cases;
}

/// Writes the text to a file and shows it to the program.
void expectFileRefused(const std::string& text, const Needles& needles) {
  const ScratchFolder folder;
  folder.write("w.json", text);
  expectRefused({"bake", "--world", folder / "w.json", "--patches", "0", "0", "1", "1", "-o", "never.r32"}, 2,
                needles);
}

TEST(WorldFile, ThatIsNoWorldIsRefusedWithOneSentenceThatNamesPlaceAndValue) {
  for (const Hostile& hostile : hostileTexts()) {
    SCOPED_TRACE(hostile.text.substr(0, 120));
    const Result<WorldDescription> world = WorldDescription::fromJson(hostile.text, "w.json");
    ASSERT_FALSE(world.ok());
    EXPECT_EQ(world.error().message.rfind("w.json", 0), 0U) << world.error().message;
    expectOneSentence(world.error().message, hostile.needles);
    expectFileRefused(hostile.text, hostile.needles);
  }
}

TEST(WorldFile, OfAWorldThatCannotBeIsRefusedWithOneSentenceThatNamesLayerFieldAndValue) {
  for (const Hostile& hostile : impossibleWorlds()) {
    SCOPED_TRACE(hostile.text);
    const Result<WorldDescription> description = WorldDescription::fromJson(hostile.text, "w.json");
    ASSERT_TRUE(description.ok()) << description.error().message;
    const auto world = World::create(*description, registryOfAllModules());
    ASSERT_FALSE(world.ok());
    expectOneSentence(world.error().message, hostile.needles);
    expectFileRefused(hostile.text, hostile.needles);
  }
}

TEST(WorldFile, ThatCannotBeReadIsRefusedByName) {
  const ScratchFolder folder;
  folder.write("empty.json", "");
  folder.write("huge.json", "{}");
  std::filesystem::resize_file(folder / "huge.json", (std::uintmax_t{16} << 20) + 1);
  std::filesystem::create_directory(folder / "folder.json");
  std::filesystem::create_symlink("nowhere", folder / "dangling.json");
  std::filesystem::create_symlink("round.json", folder / "round.json");
  ASSERT_EQ(mkfifo((folder / "pipe.json").c_str(), 0600), 0);
  const std::string endless(10'000, 'x');
  const std::vector<std::pair<std::string, std::string>> files = {
      {folder / "absent.json", "not a file that can be read"},
      {folder / "folder.json", "not a file that can be read"},
      {folder / "dangling.json", "not a file that can be read"},
      {folder / "round.json", "not a file that can be read"},
      {folder / "pipe.json", "not a file that can be read"},
      {"/dev/zero", "not a file that can be read"},
      {"/proc/self/mem", "could not be read"},
      {folder / "huge.json", "larger than 16 MiB"},
      {folder / "empty.json", "is not JSON"},
      {endless, "not a file that can be read"},
      {"two\nlines.json", "two?lines.json"}};
  for (const auto& [file, needle] : files) {
    const Result<WorldDescription> world = WorldDescription::fromFile(file);
    ASSERT_FALSE(world.ok()) << file;
    expectOneSentence(world.error().message, {needle});
    expectRefused({"bake", "--world", file, "--patches", "0", "0", "1", "1", "-o", "never.r32"}, 2, {needle});
  }
}

}  // namespace
}  // namespace teren
