#include "apps/window/WindowProgram.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

#include <Inventor/Qt/SoQt.h>
#include <QApplication>
#include <QWidget>

#include "apps/options/CommandLine.h"
#include "coin/SoTerrain.h"

namespace teren {
namespace {

volatile std::sig_atomic_t asked = 0;
const char* programName = "";

/// Qt ends a program without a usable display by abort(); this ends it with a sentence.
void exitWhenQtGivesUp(QtMsgType type, const QMessageLogContext&, const QString& message) {
  if (type == QtFatalMsg) {
    std::fprintf(stderr, "%s: cannot open a window; is DISPLAY set to a running X server?\n", programName);
    std::_Exit(kWorkFailed);
  }
  if (type == QtDebugMsg || type == QtInfoMsg) return;
  if (message.contains(QLatin1String("could not connect to display"))) return;  // the sentence above says it
  std::fprintf(stderr, "%s: %s\n", programName, message.toUtf8().constData());
}

/// Qt wants a folder of the person's own for its sockets and warns without one.
void ensureRuntimeFolder() {
  if (std::getenv("XDG_RUNTIME_DIR") != nullptr) return;
  static std::string folder = "/tmp/teren-runtime-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return;
  setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  std::atexit([] { rmdir(folder.c_str()); });
}

}  // namespace

Result<void> runWithWindows(const char* name, char** argv, const std::function<Result<void>()>& work) {
  programName = name;
  ensureRuntimeFolder();
  qInstallMessageHandler(exitWhenQtGivesUp);
  int argumentCount = 1;  // Qt's own options are not ours
  QApplication application(argumentCount, argv);
  watchForEnd();
  QWidget shell;  // SoQt asks for a top-level widget; it is never shown
  SoQt::init(&shell);
  SoTerrain::initClass();
  const Result<void> done = work();
  SoQt::done();
  return done;
}

void watchForEnd() noexcept {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::signal(signal, [](int) { asked = 1; });
  }
}

bool endAsked() noexcept {
  return asked != 0;
}

}  // namespace teren
