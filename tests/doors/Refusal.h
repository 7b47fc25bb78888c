// What every hostile case must end in: one sentence that names the culprit, the right exit status, no answer
// and no file.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/apps/teren/Program.h"

namespace teren {

/// What a sentence must name: file, field, value, what was expected.
using Needles = std::vector<std::string>;

/// A search path with every module the tests have, good, broken and hostile.
inline Program::Settings withHostileModules() {
  Program::Settings settings;
  settings.plugins = TEREN_TEST_MODULES "/good:" TEREN_TEST_MODULES "/broken:" TEREN_TEST_MODULES
                                        "/throwing:" TEREN_TEST_WORLD_MODULES;
  return settings;
}

/// One sentence of the library: one line of readable text, of bounded length, no full stop.
inline void expectOneSentence(const std::string& sentence, const Needles& needles) {
  EXPECT_FALSE(sentence.empty());
  EXPECT_LE(sentence.size(), 1400U) << sentence.substr(0, 2000);
  EXPECT_NE(sentence.back(), '.') << sentence;
  for (const char c : sentence) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << sentence;
  for (const std::string& needle : needles) {
    EXPECT_NE(sentence.find(needle), std::string::npos) << "no " << needle << " in: " << sentence;
  }
}

/// Runs the program in an empty folder and expects it to refuse.
inline void expectRefused(const Arguments& arguments, int exitCode, const Needles& needles,
                          const Program::Settings& settings = withHostileModules()) {
  std::string line = "teren";
  for (const std::string& text : arguments) line += " '" + text.substr(0, 100) + "'";
  SCOPED_TRACE(line);
  const Answer answer = Program(arguments, settings).finish();
  EXPECT_EQ(answer.exitCode, exitCode);
  EXPECT_TRUE(isOneSentence(answer.complaint)) << answer.complaint.substr(0, 2000);
  for (const std::string& needle : needles) {
    EXPECT_NE(answer.complaint.find(needle), std::string::npos)
        << "no " << needle << " in: " << answer.complaint.substr(0, 2000);
  }
  EXPECT_EQ(answer.output, "");
  EXPECT_EQ(answer.left, std::vector<std::string>()) << "a file was left behind";
}

}  // namespace teren
