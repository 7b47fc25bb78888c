#include "apps/fly/HeadUpDisplay.h"

#include <algorithm>
#include <cmath>
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
constexpr int kSmallLetters = 12, kSmallPicture = 900;  // the figures' in pictures less wide than this
constexpr int kMargin = 14;                             // between a panel and the picture's edge
constexpr int kPadding = 12;                            // between a panel's edge and its text
constexpr int kGap = 18;                                // between the two columns

const QColor kShade(12, 20, 32, 168);
const QColor kDeepShade(12, 20, 32, 215);  // where much is to be read
const QColor kEdge(255, 255, 255, 40);
const QColor kText(245, 248, 252);
const QColor kLabel(158, 192, 226);

const QColor kWarning(255, 120, 96);
const QColor kEngine(255, 190, 90);

struct Line {
  QString left, right;
  bool warning = false;
};

QString fromView(std::string_view text) {
  return QString::fromUtf8(text.data(), static_cast<int>(text.size()));
}

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

/// In several lines where it is wider than this.
QImage sentenceImage(const QString& sentence, int pixels, int mostWide = 10'000) {
  constexpr int kHow = Qt::AlignCenter | Qt::TextWordWrap;
  const QFont font = textFont(pixels);
  const QFontMetrics metrics(font);
  const QSize text =
      metrics.boundingRect(QRect(0, 0, mostWide - 2 * kPadding, 10'000), kHow, sentence).size();
  QImage image = panelImage({text.width() + 2 * kPadding, text.height() + kPadding});
  QPainter painter(&image);
  painter.setFont(font);
  painter.setPen(kText);
  painter.drawText(image.rect(), kHow, sentence);
  return image;
}

QImage legendImage(const std::vector<LegendLine>& lines) {
  const QFont font = textFont(kTextPixels - 2);
  const QFontMetrics metrics(font);
  const int step = metrics.height() + 3, swatch = metrics.height() - 2;
  int wide = 0;
  for (const LegendLine& line : lines) wide = std::max(wide, metrics.horizontalAdvance(fromView(line.says)));
  QImage image =
      panelImage({2 * kPadding + swatch + 8 + wide, 2 * kPadding + step * static_cast<int>(lines.size())});
  QPainter painter(&image);
  painter.setFont(font);
  painter.setPen(kText);
  int top = kPadding;
  for (const auto& [colour, says] : lines) {
    painter.fillRect(kPadding, top, swatch, swatch,
                     QColor::fromRgbF(static_cast<double>(colour[0]), static_cast<double>(colour[1]),
                                      static_cast<double>(colour[2])));
    painter.drawText(kPadding + swatch + 8, top + metrics.ascent() - 1, fromView(says));
    top += step;
  }
  return image;
}

constexpr int kGraphHigh = 80;  // of its highest bar

/// What stands above the bars; they are drawn over it.
QImage graphImage(const FrameGraph::Figures& figures, double scale) {
  const QFont font = textFont(kTextPixels - 2);
  const QFontMetrics metrics(font);
  QImage image = panelImage({static_cast<int>(FrameGraph::kFrames) + 2 * kPadding,
                             2 * kPadding + 2 * metrics.height() + 6 + kGraphHigh});
  QPainter painter(&image);
  painter.setFont(font);
  const auto tell = [&](int row, const QColor& colour, const QString& left, const QString& right) {
    const QRect line(kPadding, kPadding + row * metrics.height(), static_cast<int>(FrameGraph::kFrames),
                     metrics.height());
    painter.setPen(colour);
    painter.drawText(line, Qt::AlignLeft, left);
    painter.setPen(kLabel);
    painter.drawText(line, Qt::AlignRight, right);
  };
  const auto number = [](double value, int decimals) { return QString::number(value, 'f', decimals); };
  tell(0, kText, QStringLiteral("p50 %1 ms   p99 %2 ms").arg(number(figures.p50, 1), number(figures.p99, 1)),
       {});
  tell(1, kEngine, QStringLiteral("of it the engine %1 %").arg(number(100.0 * figures.engineShare, 1)),
       number(scale, 0) + QStringLiteral(" ms"));
  return image;
}

QImage tableImage(const QString& title, const std::vector<Line>& lines, const QColor& shade, int atLeastWide,
                  int letters = kTextPixels) {
  const QFont font = textFont(letters), bold = textFont(letters + 2, true);
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
  const int letters = pixels_.width() < kSmallPicture ? kSmallLetters : kTextPixels;
  const int before = std::exchange(figureLetters_, letters) == letters ? figures_.image.width() : 0;
  show(figures_, tableImage(QString(), lines, kShade, before, letters));
  if (hint_.image.isNull()) show(hint_, sentenceImage(QStringLiteral("F1  help"), kTextPixels - 2));
}

void HeadUpDisplay::setHelp(const std::vector<KeyHelp>& help) {
  helpLines_ = help;
  helpLetters_ = 0;
}

// The largest letters with which all of it is in the picture.
void HeadUpDisplay::fitHelp(QSize pixels) {
  constexpr int kLeast = 8;
  if (helpLetters_ != 0 && pixels == pixels_) return;
  std::vector<Line> lines;
  for (const KeyHelp& line : helpLines_) lines.push_back({fromView(line.keys), fromView(line.does)});
  QImage image;
  int letters = kTextPixels + 1;
  do {
    image = tableImage(QStringLiteral("Keys"), lines, kDeepShade, 0, --letters);
  } while (letters > kLeast && (image.height() > pixels.height() || image.width() > pixels.width()));
  if (letters == helpLetters_) return;
  helpLetters_ = letters;
  show(help_, std::move(image));
}

void HeadUpDisplay::setLegend(const std::vector<LegendLine>& lines) {
  if (lines == legendLines_) return;
  legendLines_ = lines;
  if (lines.empty()) {
    legend_.visible = false;
  } else {
    show(legend_, legendImage(lines));
  }
}

void HeadUpDisplay::setGraph(const FrameGraph* graph) {
  frames_ = graph;
  graph_.visible = false;
  if (graph == nullptr) return;
  const FrameGraph::Figures figures = graph->figures();
  framesScale_ = FrameGraph::scale(figures.p99);
  show(graph_, graphImage(figures, framesScale_));
}

void HeadUpDisplay::say(const std::string& sentence, Clock::duration duration) {
  show(sentence_, sentenceImage(fromView(sentence), kTextPixels, pixels_.width() - 2 * kMargin));
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
  graph_.corner = {kMargin, kMargin};
  legend_.corner = {kMargin, pixels.height() - legend_.image.height() - kMargin};
  const auto frame = [](const Panel& panel) { return QRect(panel.corner, panel.image.size()); };
  for (const Panel* other : {&legend_, &hint_}) {
    if (!other->visible || !frame(*other).intersects(frame(sentence_))) continue;
    sentence_.corner.setY(other->corner.y() - sentence_.image.height() - kMargin);
  }
}

void HeadUpDisplay::draw(QSize pixels) {
  if (Clock::now() > sentenceEnd_) sentence_.visible = false;
  if (help_.visible) fitHelp(pixels);
  pixels_ = pixels;
  place(pixels);
  glPushAttrib(GL_ALL_ATTRIB_BITS);
  glPushClientAttrib(GL_CLIENT_ALL_ATTRIB_BITS);
  beginOverlay(pixels);
  if (help_.visible) {
    draw(help_);
  } else {
    for (Panel* panel : {&figures_, &legend_, &graph_, &hint_, &sentence_, &banner_}) {
      if (panel->visible) draw(*panel);
    }
    if (graph_.visible) drawFrames();
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

/// One line for each frame, the newest on the right: what the engine took below, the rest above.
void HeadUpDisplay::drawFrames() const {
  const auto left = static_cast<float>(graph_.corner.x() + kPadding);
  const auto base = static_cast<float>(graph_.corner.y() + graph_.image.height() - kPadding);
  const auto high = [this](double milliseconds) {
    return static_cast<float>(kGraphHigh * std::min(milliseconds / framesScale_, 1.0));
  };
  glDisable(GL_TEXTURE_2D);
  glLineWidth(1.0F);
  glBegin(GL_LINES);
  const std::size_t count = frames_->count();
  for (std::size_t index = 0; index < count; ++index) {
    const FrameGraph::Frame& frame = frames_->at(index);
    const float x = left + static_cast<float>(FrameGraph::kFrames - count + index) + 0.5F;
    const float engine = base - high(static_cast<double>(frame.engine));
    glColor3ub(255, 190, 90);
    glVertex2f(x, base);
    glVertex2f(x, engine);
    glColor3ub(120, 175, 230);
    glVertex2f(x, engine);
    glVertex2f(x, base - high(static_cast<double>(frame.whole)));
  }
  glColor4f(0.5F, 0.5F, 0.5F, 0.5F);  // at 60 and at 30 frames a second
  for (const double milliseconds : {1e3 / 60.0, 1e3 / 30.0}) {
    if (milliseconds > framesScale_) continue;
    const float y = std::floor(base - high(milliseconds)) + 0.5F;
    glVertex2f(left, y);
    glVertex2f(left + static_cast<float>(FrameGraph::kFrames), y);
  }
  glEnd();
  glEnable(GL_TEXTURE_2D);
}

}  // namespace teren
