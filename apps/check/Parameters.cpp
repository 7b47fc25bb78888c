#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "teren/Quote.h"

#include "apps/check/Counterexample.h"
#include "apps/check/MapMaker.h"
#include "apps/check/Properties.h"
#include "apps/check/Subject.h"

namespace teren::check {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kMegabyte = std::size_t{1} << 20;

bool isNumber(const Parameter& parameter) {
  return parameter.type == ParameterType::real || parameter.type == ParameterType::integer;
}

/// Values no parameter like this may take.
std::vector<ParameterValue> forbidden(const Parameter& parameter) {
  std::vector<ParameterValue> values{std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity,
                                     std::string(kMegabyte, 'x')};
  if (isNumber(parameter)) {
    values.insert(values.end(),
                  {std::nextafter(parameter.max, kInfinity), std::nextafter(parameter.min, -kInfinity),
                   std::string("many"), true, std::numeric_limits<std::int64_t>::max(),
                   std::numeric_limits<std::int64_t>::min()});
  }
  if (parameter.type == ParameterType::integer) values.push_back(parameter.min + 0.5);
  if (parameter.type == ParameterType::boolean) values.push_back(std::string("true"));
  if (parameter.type == ParameterType::choice) values.push_back(std::string("no such choice"));
  if (parameter.type == ParameterType::text) {
    values.insert(values.end(), {std::string(static_cast<std::size_t>(parameter.max) + 1, ' '),
                                 std::string("line\nline"), true, std::int64_t{1}});
  }
  return values;
}

/// Values it may take, or refuse with a sentence: those just inside its range, and texts of every kind.
std::vector<ParameterValue> odd(const Parameter& parameter) {
  if (parameter.type == ParameterType::real) {
    std::vector<ParameterValue> values{std::nextafter(parameter.min, parameter.max),
                                       std::nextafter(parameter.max, parameter.min),
                                       parameter.min + 0.5 * (parameter.max - parameter.min)};
    for (const double value : {0.0, -0.0, 5e-324, -5e-324, 1e-300}) {
      if (parameter.min <= value && value <= parameter.max) values.emplace_back(value);
    }
    return values;
  }
  if (parameter.type != ParameterType::text) return {};
  const auto most = static_cast<std::size_t>(parameter.max);
  std::vector<ParameterValue> texts;
  for (const char* text :
       {"", " ", "0", "nan", "inf 1e999 -1e999", ";;;", "1 2 3; 4 5 6; 7 8 9", "\"{[(%s%n", "\xc3\xa4\xff"}) {
    texts.emplace_back(std::string(text).substr(0, most));
  }
  for (const char filler : {'x', '1', ';', ' ', '\xff'}) texts.emplace_back(std::string(most, filler));
  return texts;
}

class Parameters final : public Property {
 public:
  std::string_view name() const noexcept override { return "parameters"; }
  std::string_view demand() const noexcept override {
    return "Every parameter is explained and takes its whole range; what is hostile is refused with a "
           "sentence, or taken and makes a map.";
  }

 protected:
  std::string holds(const Subject& subject, const Effort&) const override {
    checkTexts(subject.info());
    for (const Setting& setting : subject.candidates()) {
      const std::string refusal = subject.refusal(setting);
      if (!refusal.empty())
        throw Counterexample{"with " + textOf(setting) + ", which its table allows: " + refusal};
    }
    int tried = 0;
    expectRefused(subject, {{"no such parameter", 1.0}}, "no such parameter", tried);
    Setting least, greatest;
    for (const Parameter& parameter : subject.info().parameters) {
      const std::string name(parameter.name);
      for (const ParameterValue& value : forbidden(parameter))
        expectRefused(subject, {{name, value}}, name, tried);
      const ParameterValue usual = parameter.defaultValue();
      expectRefused(subject, {{name, usual}, {name, usual}}, name, tried);
      for (const ParameterValue& value : odd(parameter)) tryOdd(subject, {{name, value}}, tried);
      if (!isNumber(parameter)) continue;
      least.emplace_back(name, parameter.min);
      greatest.emplace_back(name, parameter.max);
    }
    for (const Setting& setting : {least, greatest}) tryOdd(subject, setting, tried);
    return std::to_string(subject.candidates().size()) + " settings taken, " + std::to_string(tried) +
           " hostile ones tried";
  }

 private:
  static void checkTexts(const PluginInfo& info) {
    if (info.version.empty()) throw Counterexample{"it has no version"};
    if (info.doc.empty()) throw Counterexample{"it has no line of documentation"};
    for (const Parameter& parameter : info.parameters) {
      if (!parameter.doc.empty()) continue;
      throw Counterexample{"its parameter " + inQuotes(parameter.name) + " has no line of documentation"};
    }
  }

  static void expectRefused(const Subject& subject, const Setting& setting, const std::string& name,
                            int& tried) {
    ++tried;
    const std::string refusal = subject.refusal(setting);
    if (refusal.find(name) != std::string::npos) return;
    throw Counterexample{"with " + textOf(setting) +
                         ", which its table forbids: " + (refusal.empty() ? "it is taken" : refusal)};
  }

  static void tryOdd(const Subject& subject, const Setting& setting, int& tried) {
    ++tried;
    const std::string refusal = subject.refusal(setting);
    if (refusal.empty()) {
      const MapMaker maker = subject.maker(setting);
      const MapRequest request = requestOf(1, 9);
      const HeightMap map = maker.make(request);
      for (const float height : map.samples()) {
        if (!std::isfinite(height)) throw Counterexample{maker.place(request) + ": a sample is not finite"};
      }
    } else if (refusal.ends_with("without saying why") ||
               refusal.ends_with("made nothing of its parameters")) {
      throw Counterexample{"with " + textOf(setting) + ": " + refusal};
    }
  }
};

}  // namespace

PropertyPointer makeParameters() {
  return std::make_unique<Parameters>();
}

}  // namespace teren::check
