#include "apps/report/Page.h"

#include <fstream>
#include <thread>

namespace teren {
namespace {

constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; color: #222; background: #fff; margin: 2em auto; max-width: 72em; padding: 0 1em; }
h1 { font-size: 1.7em; } h2 { font-size: 1.25em; margin-top: 2.2em; border-bottom: 1px solid #bbb; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: 12px; }
th, td { padding: 2px 7px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap; }
th { vertical-align: bottom; background: #f2f2f2; white-space: normal; } .text { text-align: left; }
dl { font-size: 13px; } dt { font-weight: bold; } dd { margin: 0 0 .3em 1.5em; }
summary { font-size: 13px; color: #555; cursor: pointer; } svg { display: block; max-width: 100%; height: auto; }
.not { color: #a00; }
)";

std::string paragraph(const std::string& text) {
  return text.empty() ? std::string() : "<p>" + escapedForHtml(text) + "</p>\n";
}

std::string htmlOf(const PageSection& section) {
  std::string html = "<h2>" + escapedForHtml(section.title) + "</h2>\n" + paragraph(section.doc);
  if (section.table != nullptr) html += teren::htmlOf(*section.table);
  for (const std::string& picture : section.pictures) html += picture + "\n";
  return html;
}

std::string htmlOf(const Justification& choice) {
  const bool isWrong = choice.holds == false;
  const std::string verdict = !choice.holds ? "This run has not measured it."
                              : isWrong     ? "So the default is not what this run justifies."
                                            : "So the default is what this run justifies.";
  return "<li><b>" + escapedForHtml(choice.what) + ": " + escapedForHtml(choice.value) + "</b> (<code>" +
         escapedForHtml(choice.where) + "</code>). " + escapedForHtml(choice.why) + " <span" +
         (isWrong ? " class=\"not\"" : "") + ">" + verdict + "</span></li>\n";
}

}  // namespace

std::string htmlOf(const Page& page) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>" +
                     escapedForHtml(page.title) + "</title>\n<style>" + kStyle +
                     "</style></head>\n<body>\n<h1>" + escapedForHtml(page.title) + "</h1>\n";
  for (const std::string& fact : page.facts) html += paragraph(fact);
  for (const PageSection& section : page.sections) html += htmlOf(section);
  html += "<h2>Defaults</h2>\n<ul>\n";
  for (const Justification& choice : page.defaults) html += htmlOf(choice);
  return html + "</ul>\n</body>\n</html>\n";
}

std::string machineText() {
  std::ifstream file("/proc/cpuinfo");
  std::string model = "a processor of unknown model";
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    model = line.substr(colon + 2);
    break;
  }
#ifdef NDEBUG
  const std::string build = "a release build";
#else
  const std::string build = "a build with asserts, whose times are no measure of the release";
#endif
  return model + ", " + std::to_string(std::thread::hardware_concurrency()) + " processors, " + build;
}

}  // namespace teren
