#include "shared/render/text/captions.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <utility>

namespace lararium::render {
namespace {

constexpr float kCaptionLetterShare = 0.046f;  // share of the picture's height
constexpr float kCaptionSmallestPx = 14.0f;
constexpr float kCaptionWidest = 0.9f;    // share of the picture's width
constexpr float kNameSize = 0.72f;        // letters of a name, share of the text's em
constexpr float kCaptionRowStep = 1.32f;  // em
constexpr float kCaptionPadding = 0.5f;   // em
constexpr float kCaptionMargin = 0.05f;   // margin below, share of the picture's height
constexpr float kGap = 0.35f;             // em, between captions
constexpr float kCaptionTallest = 0.42f;  // limit for large letters, share of the picture's height
constexpr float kSmaller = 0.94f;         // ratio of consecutive sizes that are tried
constexpr float kCaptionGroundOpacity = 0.66f;
constexpr float kCaptionEdge = 0.08f;  // em, edge of a ground in high contrast
constexpr glm::vec3 kNameOfHighContrast(1.0f, 0.88f, 0.1f);
constexpr float kLegendShare = 0.031f;  // letters, share of the picture's height
constexpr float kSmallestLegendPx = 12.0f;
constexpr float kLegendWidth = 0.46f;                      // text, share of the picture's width
constexpr float kLegendTop = 0.04f;                        // margin, share of the picture's height
constexpr int kMostLegendRows = 8;                         // rows of its text
constexpr float kSwatch = 0.95f;                           // em
constexpr float kSwatchGap = 0.5f;                         // em, between a swatch and its text
constexpr float kSwatchStripes = 2.4f;                     // stripes along a side of a swatch
constexpr float kCaptionRadius = 0.014f;                   // corners, share of the picture's height
constexpr std::string_view kArrowLeft = "\xE2\x86\x90 ";   // U+2190
constexpr std::string_view kArrowRight = " \xE2\x86\x92";  // U+2192

float NameWidth(const CaptionFont& font, const Caption& caption) {
  const float arrow = caption.side == CaptionSide::kHere   ? 0.0f
                      : caption.side == CaptionSide::kLeft ? TextWidth(font, kArrowLeft)
                                                           : TextWidth(font, kArrowRight);
  return kNameSize * (TextWidth(font, caption.speaker) + arrow);
}

// The width of a row that may contain breaks of the text, em.
float RowWidth(const CaptionFont& font, std::string_view row) {
  const auto breaks = static_cast<float>(std::count(row.begin(), row.end(), '\n'));
  return TextWidth(font, row) + breaks * TextWidth(font, " ");
}

enum class Breaks { kKept, kFlow };

// Removes the first row from a text and returns it: as many whole words as fit into `widest` em, or
// a single word that is wider.
std::string_view TakeRow(const CaptionFont& font,
                         float widest,
                         Breaks breaks,
                         std::string_view& text) {
  size_t end = 0;
  while (end < text.size() && (text[end] != '\n' || breaks == Breaks::kFlow)) {
    const size_t next = std::min(text.find_first_of(" \n", end + 1), text.size());
    if (end > 0 && RowWidth(font, text.substr(0, next)) > widest) {
      break;
    }
    end = next;
  }
  const std::string_view row = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return row;
}

// A caption broken into rows. limit: largest width of a row in em, ignoring the breaks of the text;
// 0: rows are those of the text.
struct Block {
  float em = 0.0f;  // pixels
  float limit = 0.0f;
  float widest = 0.0f;  // em
  int rows = 0;
};

template <typename Visit>
void ForEachRowOf(const CaptionFont& font, std::string_view text, float limit, Visit visit) {
  if (limit <= 0.0f) {
    ForEachRow(text, visit);
    return;
  }
  while (!text.empty()) {
    visit(TakeRow(font, limit, Breaks::kFlow, text));
  }
}

Block BreakInto(const CaptionFont& font, const Caption& caption, float limit) {
  Block block;
  block.limit = limit;
  block.widest = NameWidth(font, caption);
  ForEachRowOf(font, caption.text, limit, [&](std::string_view row) {
    block.widest = std::max(block.widest, RowWidth(font, row));
    ++block.rows;
  });
  return block;
}

// The height of a caption with its padding, em.
float HeightOf(const Block& block, const Caption& caption) {
  const float name = caption.speaker.empty() ? 0.0f : kNameSize;
  return kCaptionRowStep * (static_cast<float>(block.rows) + name) + 2.0f * kCaptionPadding -
         (kCaptionRowStep - 1.0f);
}

// Breaks a caption into as few rows as possible, of about equal width.
Block Flow(const CaptionFont& font, const Caption& caption, float limit) {
  Block block = BreakInto(font, caption, limit);
  float narrow = RowWidth(font, caption.text) / static_cast<float>(std::max(block.rows, 1));
  for (; narrow < limit; narrow += 1.0f) {
    const Block even = BreakInto(font, caption, narrow);
    if (even.rows <= block.rows) {
      return even;
    }
  }
  return block;
}

// Chooses the size of letters: as large as the style asks for and fits, with the text's own rows if
// possible. Otherwise the usual size is used, and less if a row would be too wide.
Block FitInto(const CaptionFont& font,
              const Caption& caption,
              const CaptionStyle& style,
              glm::vec2 size) {
  const float usual = std::max(kCaptionLetterShare * size.y, kCaptionSmallestPx);
  const Block own = BreakInto(font, caption, 0.0f);
  for (float em = usual * ScaleOf(style.size); em > usual; em *= kSmaller) {
    const float limit = kCaptionWidest * size.x / em - 2.0f * kCaptionPadding;
    Block block = own.widest <= limit ? own : Flow(font, caption, limit);
    if (block.widest <= limit && em * HeightOf(block, caption) <= kCaptionTallest * size.y) {
      block.em = em;
      return block;
    }
  }
  Block block = own;
  block.em = std::min(
      usual, kCaptionWidest * size.x / std::max(own.widest + 2.0f * kCaptionPadding, 1.0f));
  return block;
}

// Adds a row. A row that contains breaks of the text is added in pieces.
void AddRow(const CaptionFont& font,
            std::string_view row,
            glm::vec2 baseline,
            float em,
            CaptionLayout& layout) {
  ForEachRow(row, [&](std::string_view piece) {
    layout.rows.push_back({piece, baseline, em, glm::vec3(1.0f)});
    baseline.x += em * (TextWidth(font, piece) + TextWidth(font, " "));
  });
}

// Lays out a caption from its bottom edge upwards. Returns its top edge.
float LayOutOne(const CaptionFont& font,
                const Caption& caption,
                const CaptionStyle& style,
                glm::vec2 size,
                float bottom,
                CaptionLayout& layout) {
  const Block block = FitInto(font, caption, style, size);
  const float em = block.em;
  const bool named = !caption.speaker.empty();
  const float top = bottom - em * HeightOf(block, caption);
  const float half = em * (0.5f * block.widest + kCaptionPadding);
  layout.grounds.push_back(
      {{0.5f * size.x - half, top}, {0.5f * size.x + half, bottom}, em * kCaptionEdge});
  const auto middle = [&](float width_em, float y) {
    return glm::vec2(std::round(0.5f * (size.x - em * width_em)), std::round(y));
  };
  float baseline = top + em * (kCaptionPadding + 0.78f * (named ? kNameSize : 1.0f));
  if (named) {
    layout.rows.push_back({caption.speaker, middle(NameWidth(font, caption), baseline),
                           kNameSize * em, style.is_high() ? kNameOfHighContrast : caption.colour,
                           caption.side});
    baseline += em * (kCaptionRowStep * kNameSize + 0.78f * (1.0f - kNameSize));
  }
  ForEachRowOf(font, caption.text, block.limit, [&](std::string_view row) {
    AddRow(font, row, middle(RowWidth(font, row), baseline), em, layout);
    baseline += em * kCaptionRowStep;
  });
  return top - kGap * em;
}

}  // namespace

void LayOut(const CaptionFont& font,
            std::span<const Caption> captions,
            const CaptionStyle& style,
            int width,
            int height,
            CaptionLayout& layout) {
  layout.rows.clear();
  layout.grounds.clear();
  layout.swatches.clear();
  const glm::vec2 size(width, height);
  float bottom = size.y * (1.0f - kCaptionMargin);
  for (const Caption& caption : captions) {
    if (!caption.text.empty()) {
      bottom = LayOutOne(font, caption, style, size, bottom, layout);
    }
  }
}

void LayOutLegend(
    const CaptionFont& font, const Legend& legend, int width, int height, CaptionLayout& layout) {
  const glm::vec2 size(width, height);
  const float em = std::max(kLegendShare * size.y, kSmallestLegendPx);
  const glm::vec2 corner(std::round(kLegendTop * size.y));
  const float left = corner.x + em * kCaptionPadding;
  float baseline = corner.y + em * (kCaptionPadding + 0.78f);
  float widest = 0.0f;  // pixels
  const auto add = [&](std::string_view text, float indent, const glm::vec3& colour) {
    layout.rows.push_back({text, glm::vec2(std::round(left + indent), std::round(baseline)), em,
                           colour, CaptionSide::kHere});
    widest = std::max(widest, indent + em * TextWidth(font, text));
    baseline += em * kCaptionRowStep;
  };
  const size_t ground = layout.grounds.size();
  layout.grounds.push_back({corner, corner, em * kCaptionEdge});
  for (const LegendEntry& entry : legend.entries) {
    const glm::vec2 from(left, std::round(baseline - 0.83f * em));
    layout.swatches.push_back(
        {{from, from + em * kSwatch}, entry.colour, entry.stripes, em * kSwatch / kSwatchStripes});
    add(entry.text, em * (kSwatch + kSwatchGap), glm::vec3(1.0f));
  }
  if (!legend.title.empty()) {
    baseline += em * kGap;
    add(legend.title, 0.0f, legend.title_colour);
  }
  std::string_view text = legend.text;
  for (int row = 0; row < kMostLegendRows && !text.empty(); ++row) {
    add(TakeRow(font, kLegendWidth * size.x / em, Breaks::kKept, text), 0.0f, glm::vec3(1.0f));
  }
  layout.grounds[ground].to = {left + widest + em * kCaptionPadding,
                               baseline - em * (kCaptionRowStep - 0.22f - kCaptionPadding)};
}

CaptionPainter::CaptionPainter(std::unique_ptr<FlatPainter> flat) : flat_(std::move(flat)) {}
CaptionPainter::~CaptionPainter() = default;

Result<std::unique_ptr<CaptionPainter>> CaptionPainter::Create(CaptionFont font) {
  LARARIUM_ASSIGN_OR_RETURN(std::unique_ptr<FlatPainter> flat,
                            FlatPainter::Create(std::move(font)));
  return std::unique_ptr<CaptionPainter>(new CaptionPainter(std::move(flat)));
}

void CaptionPainter::Draw(std::span<const Caption> captions,
                          const Legend* legend,
                          const CaptionStyle& style,
                          const RenderTarget& target) {
  LayOut(flat_->font(), captions, style, target.width(), target.height(), layout_);
  if (legend != nullptr) {
    LayOutLegend(flat_->font(), *legend, target.width(), target.height(), layout_);
  }
  if (layout_.grounds.empty()) {
    return;
  }
  const float radius_px = kCaptionRadius * static_cast<float>(target.height());
  flat_->Begin(target);
  for (const CaptionLayout::Ground& ground : layout_.grounds) {
    DrawGround(*flat_, {ground.from, ground.to, radius_px, ground.edge_px}, kCaptionGroundOpacity,
               style);
  }
  for (const CaptionLayout::Swatch& swatch : layout_.swatches) {
    flat_->Rectangle(swatch.place.from, swatch.place.to, 0.25f * radius_px,
                     glm::vec4(swatch.colour, 1.0f), {swatch.stripes, swatch.stripe_px});
  }
  for (const CaptionLayout::Row& row : layout_.rows) {
    const glm::vec4 colour(row.colour, 1.0f);
    const float bolder = BolderOf(style);
    glm::vec2 pen = row.baseline;
    if (row.side == CaptionSide::kLeft) {
      pen.x = flat_->Text(kArrowLeft, pen, row.em, colour, bolder);
    }
    pen.x = flat_->Text(row.text, pen, row.em, colour, bolder);
    if (row.side == CaptionSide::kRight) {
      flat_->Text(kArrowRight, pen, row.em, colour, bolder);
    }
  }
  flat_->End();
}

}  // namespace lararium::render
