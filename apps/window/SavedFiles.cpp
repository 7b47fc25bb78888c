#include "apps/window/SavedFiles.h"

#include <QDateTime>
#include <QDir>
#include <QSaveFile>
#include <QStandardPaths>
#include <QString>

#include "teren/Quote.h"

namespace teren {
namespace {

Error cannotWrite(const std::string& file, const QSaveFile& saved) {
  return Error{"cannot write " + inQuotes(file) + ": " + saved.errorString().toStdString()};
}

}  // namespace

std::string newPictureName() {
  const QString pictures = QStandardPaths::writableLocation(QStandardPaths::PicturesLocation);
  const QDir folder(QDir(pictures).exists() ? pictures : QDir::currentPath());
  const QString time = QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd-hhmmss-zzz"));
  return folder.absoluteFilePath(QStringLiteral("teren-%1.png").arg(time)).toStdString();
}

Result<void> savePicture(const QImage& picture, const std::string& file) {
  if (picture.isNull()) return Error{"cannot write " + inQuotes(file) + ": the window showed no picture"};
  QSaveFile saved(QString::fromStdString(file));
  if (!saved.open(QIODevice::WriteOnly) || !picture.save(&saved, "PNG") || !saved.commit()) {
    return cannotWrite(file, saved);
  }
  return {};
}

Result<void> saveText(std::string_view text, const std::string& file) {
  QSaveFile saved(QString::fromStdString(file));
  const auto size = static_cast<qint64>(text.size());
  if (!saved.open(QIODevice::WriteOnly) || saved.write(text.data(), size) != size || !saved.commit()) {
    return cannotWrite(file, saved);
  }
  return {};
}

}  // namespace teren
