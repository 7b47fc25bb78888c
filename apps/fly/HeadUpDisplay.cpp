#include "apps/fly/HeadUpDisplay.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <QColor>
#include <QFont>
#include <QFontMetrics>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QPainter>
#include <QString>

namespace teren {
namespace {

constexpr int kTextPixels = 15;
constexpr int kMargin = 14;   // between a panel and the picture's edge
constexpr int kPadding = 12;  // between a panel's edge and its text
constexpr int kGap = 18;      // between the two columns

const QColor kShade(12, 20, 32, 168);
const QColor kDeepShade(12, 20, 32, 215);  // where much is to be read
const QColor kEdge(255, 255, 255, 40);
const QColor kText(245, 248, 252);
const QColor kLabel(158, 192, 226);

const QColor kWarning(255, 120, 96);

struct Line {
  QString left, right;
  bool warning = false;
};

QFont textFont(int pixels, bool bold = false) {
  QFont font(QStringLiteral("DejaVu Sans"));
  font.setStyleHint(QFont::SansSerif);
  font.setPixelSize(pixels);
  font.setBold(bold);
  return font;
}

QImage panelImage(QSize size, const QColor& shade = kShade) {
  QImage image(size, QImage::Format_RGBA8888_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setBrush(shade);
  painter.setPen(kEdge);
  painter.drawRoundedRect(QRectF(0.5, 0.5, size.width() - 1.0, size.height() - 1.0), 7.0, 7.0);
  return image;
}

QImage sentenceImage(const QString& sentence, int pixels) {
  const QFont font = textFont(pixels);
  const QFontMetrics metrics(font);
  QImage image =
      panelImage({metrics.horizontalAdvance(sentence) + 2 * kPadding, metrics.height() + kPadding});
  QPainter painter(&image);
  painter.setFont(font);
  painter.setPen(kText);
  painter.drawText(image.rect(), Qt::AlignCenter, sentence);
  return image;
}

QImage tableImage(const QString& title, const std::vector<Line>& lines, const QColor& shade,
                  int atLeastWide) {
  const QFont font = textFont(kTextPixels), bold = textFont(kTextPixels + 2, true);
  const QFontMetrics metrics(font);
  int left = 0, right = 0;
  for (const Line& line : lines) {
    left = std::max(left, metrics.horizontalAdvance(line.left));
    right = std::max(right, metrics.horizontalAdvance(line.right));
  }
  const int step = metrics.height() + 2;
  const int top = title.isEmpty() ? kPadding : kPadding + step + 8;
  const int width = std::max(atLeastWide, left + kGap + right + 2 * kPadding);
  QImage image = panelImage({width, top + step * static_cast<int>(lines.size()) + kPadding}, shade);
  QPainter painter(&image);
  painter.setPen(kText);
  painter.setFont(bold);
  if (!title.isEmpty()) painter.drawText(kPadding, kPadding + metrics.ascent(), title);
  painter.setFont(font);
  int base = top + metrics.ascent();
  for (const Line& line : lines) {
    painter.setPen(line.warning ? kWarning : kLabel);
    painter.drawText(kPadding, base, line.left);
    painter.setPen(line.warning ? kWarning : kText);
    painter.drawText(kPadding + left + kGap, base, line.right);
    base += step;
  }
  return image;
}

QString fromView(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

void upload(const QImage& image, unsigned& texture) {
  if (texture == 0) {
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  glBindTexture(GL_TEXTURE_2D, texture);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, image.bytesPerLine() / 4);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width(), image.height(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image.constBits());
}

void beginOverlay(QSize pixels) {
  QOpenGLFunctions* gl = QOpenGLContext::currentContext()->functions();
  gl->glUseProgram(0);
  gl->glBindBuffer(GL_ARRAY_BUFFER, 0);
  gl->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, 0);
  gl->glActiveTexture(GL_TEXTURE0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_LIGHTING);
  glDisable(GL_FOG);
  glDisable(GL_CULL_FACE);
  glDisable(GL_ALPHA_TEST);
  glEnable(GL_TEXTURE_2D);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
  glViewport(0, 0, pixels.width(), pixels.height());
  glMatrixMode(GL_TEXTURE);
  glPushMatrix();
  glLoadIdentity();
  glMatrixMode(GL_PROJECTION);
  glPushMatrix();
  glLoadIdentity();
  glOrtho(0.0, pixels.width(), pixels.height(), 0.0, -1.0, 1.0);
  glMatrixMode(GL_MODELVIEW);
  glPushMatrix();
  glLoadIdentity();
}

void endOverlay() {
  glMatrixMode(GL_MODELVIEW);
  glPopMatrix();
  glMatrixMode(GL_PROJECTION);
  glPopMatrix();
  glMatrixMode(GL_TEXTURE);
  glPopMatrix();
}

}  // namespace

void HeadUpDisplay::show(Panel& panel, QImage image) {
  panel.image = std::move(image);
  panel.visible = true;
  panel.changed = true;
}

void HeadUpDisplay::setLines(std::vector<DisplayLine> wanted) {
  if (wanted == lines_) return;
  lines_ = std::move(wanted);
  std::vector<Line> lines;
  for (const auto& [what, says, warning] : lines_) lines.push_back({fromView(what), fromView(says), warning});
  // Never narrower than before, so that the panel does not tremble with its digits.
  show(figures_, tableImage(QString(), lines, kShade, figures_.image.width()));
  if (hint_.image.isNull()) show(hint_, sentenceImage(QStringLiteral("F1  help"), kTextPixels - 2));
}

void HeadUpDisplay::setHelp(const std::vector<KeyHelp>& help) {
  const bool visible = help_.visible;
  std::vector<Line> lines;
  for (const KeyHelp& line : help) lines.push_back({fromView(line.keys), fromView(line.does)});
  show(help_, tableImage(QStringLiteral("Keys"), lines, kDeepShade, 0));
  help_.visible = visible;
}

void HeadUpDisplay::say(const std::string& sentence, Clock::duration duration) {
  show(sentence_, sentenceImage(fromView(sentence), kTextPixels));
  sentenceEnd_ = Clock::now() + duration;
}

void HeadUpDisplay::setBanner(const std::string& word) {
  if (word == bannerWord_) return;
  bannerWord_ = word;
  if (word.empty()) {
    banner_.visible = false;
  } else {
    show(banner_, sentenceImage(fromView(word), 2 * kTextPixels));
  }
}

void HeadUpDisplay::place(QSize pixels) {
  const auto centred = [&pixels](const Panel& panel) { return (pixels.width() - panel.image.width()) / 2; };
  const auto above = [&pixels](const Panel& panel, int share) {
    return (pixels.height() - panel.image.height()) * share / 100;
  };
  // On the right: what overtakes comes on the left.
  figures_.corner = {pixels.width() - figures_.image.width() - kMargin, kMargin};
  help_.corner = {centred(help_), above(help_, 50)};
  banner_.corner = {centred(banner_), above(banner_, 35)};
  sentence_.corner = {centred(sentence_), pixels.height() - sentence_.image.height() - kMargin};
  hint_.corner = {pixels.width() - hint_.image.width() - kMargin,
                  pixels.height() - hint_.image.height() - kMargin};
}

void HeadUpDisplay::draw(QSize pixels) {
  if (Clock::now() > sentenceEnd_) sentence_.visible = false;
  place(pixels);
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  beginOverlay(pixels);
  for (Panel* panel : {&figures_, &hint_, &sentence_, &banner_, &help_}) {
    if (panel->visible) draw(*panel);
  }
  endOverlay();
  glPopClientAttrib();
  glPopAttrib();
}

void HeadUpDisplay::draw(Panel& panel) {
  if (panel.changed) upload(panel.image, panel.texture);
  panel.changed = false;
  glBindTexture(GL_TEXTURE_2D, panel.texture);
  const int left = panel.corner.x(), top = panel.corner.y();
  const int right = left + panel.image.width(), bottom = top + panel.image.height();
  glBegin(GL_QUADS);
  glTexCoord2i(0, 0);
  glVertex2i(left, top);
  glTexCoord2i(0, 1);
  glVertex2i(left, bottom);
  glTexCoord2i(1, 1);
  glVertex2i(right, bottom);
  glTexCoord2i(1, 0);
  glVertex2i(right, top);
  glEnd();
}

}  // namespace teren
