#include "editor/train/capture_report.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "editor/train/capture_analysis.h"
#include "shared/core/file.h"
#include "shared/core/html_text.h"
#include "shared/image/encode.h"

namespace lararium::train {
namespace {

// ------------------------------------------------------------ pieces of HTML

constexpr std::string_view kStyle = R"(
:root{--ink:#22303a;--soft:#5d6b75;--line:#d9dfe2;--paper:#fff;--tint:#f4f6f6;--good:#2a7f76;
--fair:#d8a73a;--poor:#d0714a;--none:#a33b36}
*{box-sizing:border-box}
body{margin:0;background:var(--tint);color:var(--ink);font:16px/1.5 system-ui,"Helvetica Neue",Arial,sans-serif}
main{max-width:1080px;margin:0 auto;padding:32px 24px;background:var(--paper)}
h1{font-size:30px;line-height:1.2;margin:0}h2{font-size:20px;margin:40px 0 12px;padding-top:16px;border-top:1px solid var(--line)}
h3{font-size:15px;margin:0 0 6px}
p{margin:6px 0;max-width:72ch}.soft{color:var(--soft)}small,.small{font-size:13px;color:var(--soft)}
.verdict{font-size:19px;margin:14px 0 20px}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:1px;background:var(--line);border:1px solid var(--line)}
.facts div{background:var(--paper);padding:10px 14px}.facts b{display:block;font-size:22px;font-weight:600;font-variant-numeric:tabular-nums}
.facts span{font-size:13px;color:var(--soft)}
ol.advice{padding-left:22px;margin:8px 0}ol.advice li{margin:8px 0;max-width:80ch}
.two{display:grid;grid-template-columns:1fr 1fr;gap:28px}.three{display:grid;grid-template-columns:repeat(3,1fr);gap:28px}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(170px,1fr));gap:14px}
figure{margin:0;break-inside:avoid}figure img{width:100%;display:block;background:var(--tint)}
figcaption{font-size:13px;color:var(--soft);margin-top:4px;overflow-wrap:anywhere}
svg{width:100%;height:auto;display:block}svg text{font:12px system-ui,Arial,sans-serif;fill:var(--soft)}
.key{display:flex;flex-wrap:wrap;gap:4px 18px;font-size:13px;color:var(--soft);margin:8px 0}
.key i{display:inline-block;width:12px;height:12px;margin-right:6px;vertical-align:-1px}
table{border-collapse:collapse;align-self:start;font-variant-numeric:tabular-nums}td,th{padding:5px 22px 5px 0;text-align:left;border-bottom:1px solid var(--line);font-weight:400;vertical-align:top}
th{color:var(--soft);font-size:13px}
.weak{display:grid;grid-template-columns:repeat(auto-fill,minmax(230px,1fr));gap:20px}
.tag{display:inline-block;font-size:13px;padding:0 7px;border:1px solid currentColor;border-radius:3px}
@media(max-width:760px){.two,.three{grid-template-columns:1fr}}
@media print{body{background:none}main{padding:0;max-width:none}h2{break-after:avoid}section{break-inside:avoid-page}
*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

constexpr std::array<std::string_view, 4> kQualityColours = {"#2a7f76", "#d8a73a", "#d0714a",
                                                             "#a33b36"};
constexpr std::array<std::string_view, 4> kQualityFills = {"#cfe6e1", "#f4e6bf", "#f3cdb8",
                                                           "#e2aaa5"};
constexpr std::array<std::string_view, 4> kQualityNames = {"good", "fair", "poor", "none"};

std::string FixedOrDash(double value, int decimals) {
  if (!std::isfinite(value)) {
    return "-";
  }
  std::array<char, 64> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), std::clamp(value, -1e12, 1e12),
                    std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

std::string Base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t triple = 0;
    for (size_t j = 0; j < 3; ++j) {
      triple = triple << 8 | (j < count ? static_cast<uint32_t>(bytes[i + j]) : 0u);
    }
    for (size_t j = 0; j < 4; ++j) {
      text += j <= count ? kDigits[triple >> (18 - 6 * j) & 63] : '=';
    }
  }
  return text;
}

// An <img> of at most width pixels; empty if there is no picture.
std::string Picture(const cv::Mat& image, int width, std::string_view alt) {
  if (image.empty()) {
    return {};
  }
  try {
    cv::Mat small = image;
    if (image.cols > width) {
      const int height = std::max(1, image.rows * width / image.cols);
      cv::resize(image, small, cv::Size(width, height), 0, 0, cv::INTER_AREA);
    }
    const auto jpeg = image::EncodeJpeg(small, 80);
    return !jpeg.ok() ? std::string()
                      : "<img alt=\"" + EscapeHtml(alt) + "\" src=\"data:image/jpeg;base64," +
                            Base64(*jpeg) + "\">";
  } catch (const cv::Exception&) {
    return {};
  }
}

// Whole percent; 100 only if nothing is missing.
std::string Percent(double share) {
  return FixedOrDash(share < 1.0 ? std::min(99.0, std::round(100.0 * share)) : 100.0, 0) + " %";
}

std::string Size(uint64_t bytes) {
  return FixedOrDash(static_cast<double>(bytes) / (1024.0 * 1024.0), 1) + " MiB";
}

// <b data-NAME="value">shown</b>
std::string Fact(std::string_view name, const std::string& value, const std::string& shown) {
  return "<b data-" + std::string(name) + "=\"" + value + "\">" + shown + "</b>";
}

std::string FactBox(std::string_view name,
                    const std::string& value,
                    const std::string& shown,
                    std::string_view what) {
  return "<div>" + Fact(name, value, shown) + "<span>" + std::string(what) + "</span></div>\n";
}

std::string KeyEntry(std::string_view colour, std::string_view what) {
  return "<span><i style=\"background:" + std::string(colour) + "\"></i>" + std::string(what) +
         "</span>";
}

// ------------------------------------------------------------ the page

// Maps plan coordinates to a drawing.
struct PlanScale {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  double scale = 1.0;
  double width = 0.0;
  double height = 0.0;

  Eigen::Vector2d operator()(const Eigen::Vector2d& plan) const {
    return {(plan.x() - low.x()) * scale, height - (plan.y() - low.y()) * scale};
  }
  bool Contains(const Eigen::Vector2d& at) const {
    return at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= width && at.y() <= height;
  }
};

class Page {
 public:
  Page(const TrainReport& report,
       const vision::SceneDatabase& database,
       const CaptureReportOptions& options)
      : report_(report),
        database_(database),
        options_(options),
        analysis_(AnalyseCapture(report, database, options.metres_per_unit)) {}

  std::string Format() {
    const std::string title = options_.title.empty() ? "Place" : EscapeHtml(options_.title);
    html_ =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
        title + ": capture report</title>\n<style>" + std::string(kStyle) +
        "</style></head>\n<body><main>\n";
    AddHead(title);
    AddAdvice();
    AddPlans();
    AddFilmed();
    AddWeakFrames();
    AddHistograms();
    AddSessions();
    AddFacts();
    html_ += "</main></body></html>\n";
    return std::move(html_);
  }

 private:
  // ---------------------------------------------------------- summary

  double LocatedShare() const {
    return report_.frames > 0 ? static_cast<double>(report_.located.size()) / report_.frames : 0.0;
  }

  std::array<size_t, 4> PlacesOfQuality() const {
    std::array<size_t, 4> counts = {};
    for (const StandingPlace& place : analysis_.places) {
      ++counts[static_cast<size_t>(QualityOf(place.prediction))];
    }
    return counts;
  }

  double WellLocatedShare() const {
    const std::array<size_t, 4> counts = PlacesOfQuality();
    const size_t all = analysis_.places.size();
    return all == 0 ? 0.0 : static_cast<double>(counts[0] + counts[1]) / static_cast<double>(all);
  }

  void AddHead(const std::string& title) {
    html_ += "<header><p class=\"soft\">Capture report</p><h1>" + title + "</h1>\n";
    if (!options_.source.empty()) {
      html_ += "<p class=\"soft\">from " + EscapeHtml(options_.source) + "</p>\n";
    }
    const double located = LocatedShare();
    const double well = WellLocatedShare();
    const char* verdict = located > 0.95 && well > 0.8  ? "The place is covered well."
                          : located > 0.8 && well > 0.5 ? "The place is covered, with gaps."
                                                        : "The place needs more filming.";
    html_ += std::string("<p class=\"verdict\"><strong>") + verdict + "</strong> " +
             Percent(located) +
             " of the frames were located. Around the camera path, a visitor "
             "will be located well in " +
             Percent(well) + " of the places.</p>\n";
    html_ += "<div class=\"facts\">\n";
    html_ += FactBox("frames", std::to_string(report_.frames), std::to_string(report_.frames),
                     "frames filmed");
    html_ += FactBox("located", std::to_string(report_.located.size()),
                     std::to_string(report_.located.size()), "frames located");
    html_ += FactBox("keyframes", std::to_string(database_.keyframes.size()),
                     std::to_string(database_.keyframes.size()), "keyframes in the map");
    html_ += FactBox("points", std::to_string(database_.points.size()),
                     std::to_string(database_.points.size()), "points in the map");
    html_ += FactBox("observations", std::to_string(database_.observations.size()),
                     std::to_string(database_.observations.size()), "observations of points");
    html_ += FactBox("error", FixedOrDash(database_.mean_reprojection_error_px, 4),
                     FixedOrDash(database_.mean_reprojection_error_px, 2) + " px",
                     "mean reprojection error");
    html_ += "</div></header>\n";
  }

  void AddAdvice() {
    html_ += "<section><h2>What to film next</h2>\n<ol class=\"advice\">\n";
    constexpr size_t kMost = 12;
    for (size_t i = 0; i < std::min(kMost, analysis_.advice.size()); ++i) {
      html_ += "<li>" + EscapeHtml(AdviceSentence(analysis_.advice[i]).English()) + "</li>\n";
    }
    html_ += "</ol>\n";
    if (analysis_.advice.size() > kMost) {
      html_ += "<p class=\"small\">and " + std::to_string(analysis_.advice.size() - kMost) +
               " smaller matters.</p>\n";
    }
    html_ += "</section>\n";
  }

  // ---------------------------------------------------------- plans

  // Chooses a scale that shows all cameras and places, and most of the points.
  PlanScale MakeScale() const {
    std::vector<double> x;
    std::vector<double> y;
    for (const Eigen::Vector3f& point : database_.points) {
      const Eigen::Vector2d at = analysis_.plan(point.cast<double>());
      x.push_back(at.x());
      y.push_back(at.y());
    }
    std::sort(x.begin(), x.end());
    std::sort(y.begin(), y.end());
    Eigen::Vector2d low(1e9, 1e9);
    Eigen::Vector2d high(-1e9, -1e9);
    const auto include = [&](const Eigen::Vector2d& at) {
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    };
    if (!x.empty()) {
      const size_t outer = x.size() / 50;
      include({x[outer], y[outer]});
      include({x[x.size() - 1 - outer], y[y.size() - 1 - outer]});
    }
    for (const vision::Keyframe& keyframe : database_.keyframes) {
      include(analysis_.plan(keyframe.camera_from_map.Center()));
    }
    for (const StandingPlace& place : analysis_.places) {
      include(place.center);
    }
    PlanScale scale;
    const Eigen::Vector2d extent = (high - low).cwiseMax(1e-9);
    const double border = 0.04 * extent.maxCoeff();
    scale.low = low.array() - border;
    const Eigen::Vector2d size = extent.array() + 2.0 * border;
    scale.scale = std::min(500.0 / size.x(), 560.0 / size.y());
    scale.width = scale.scale * size.x();
    scale.height = scale.scale * size.y();
    return scale;
  }

  std::string PlanStart(const PlanScale& scale, std::string_view label) const {
    return "<svg viewBox=\"0 0 " + FixedOrDash(scale.width, 0) + " " +
           FixedOrDash(scale.height + 24, 0) + "\" role=\"img\" aria-label=\"" +
           std::string(label) + "\">\n";
  }

  // An SVG path of dots.
  std::string Dots(const std::vector<Eigen::Vector2d>& places,
                   std::string_view colour,
                   double size) const {
    std::string path;
    for (const Eigen::Vector2d& at : places) {
      path += "M" + FixedOrDash(at.x(), 1) + " " + FixedOrDash(at.y(), 1) + "h0";
    }
    return "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + std::string(colour) +
           "\" stroke-width=\"" + FixedOrDash(size, 1) + "\" stroke-linecap=\"round\"/>\n";
  }

  // The points of the map; well determined points are darker.
  std::string PointDots(const PlanScale& scale) const {
    constexpr size_t kMost = 6000;
    constexpr float kWell = 8.0f * std::numbers::pi_v<float> / 180.0f;
    const size_t stride = std::max<size_t>(1, (database_.points.size() + kMost - 1) / kMost);
    std::vector<Eigen::Vector2d> well;
    std::vector<Eigen::Vector2d> weakly;
    for (size_t i = 0; i < database_.points.size(); i += stride) {
      const Eigen::Vector2d at = scale(analysis_.plan(database_.points[i].cast<double>()));
      if (scale.Contains(at)) {
        (analysis_.point_parallax[i] >= kWell ? well : weakly).push_back(at);
      }
    }
    return Dots(weakly, "#c3ccd1", 1.6) + Dots(well, "#7e8d96", 1.6);
  }

  // A scale bar of a round length.
  std::string Ruler(const PlanScale& scale) const {
    const double metres = options_.metres_per_unit.value_or(1.0);
    const double about = 100.0 / scale.scale * metres;  // Length of 100 drawn units.
    const double power = std::pow(10.0, std::floor(std::log10(about)));
    const double length = about >= 5.0 * power   ? 5.0 * power
                          : about >= 2.0 * power ? 2.0 * power
                                                 : power;
    const double drawn = length / metres * scale.scale;
    const int decimals = length < 1.0 ? static_cast<int>(std::ceil(-std::log10(length))) : 0;
    const std::string y = FixedOrDash(scale.height + 10, 1);
    return "<path d=\"M4 " + y + "h" + FixedOrDash(drawn, 1) +
           "\" stroke=\"#22303a\" stroke-width=\"2\"/><text x=\"" + FixedOrDash(drawn + 12, 1) +
           "\" y=\"" + FixedOrDash(scale.height + 14, 1) + "\">" + FixedOrDash(length, decimals) +
           (options_.metres_per_unit ? " m" : " map units") + "</text>\n";
  }

  // The camera path: dots for located frames of this training, crosses for missing frames, rings
  // for keyframes of other sessions.
  std::string PathDrawing(const PlanScale& scale) const {
    std::string svg;
    std::string line;
    std::vector<Eigen::Vector2d> good;
    std::vector<Eigen::Vector2d> weak;
    std::string crosses;
    std::map<std::string, Eigen::Vector3d> own;  // Camera centres by frame name.
    std::optional<Eigen::Vector2d> previous;
    bool gap = false;
    for (size_t i = 0; i < report_.frame_reports.size(); ++i) {
      const FrameReport& frame = report_.frame_reports[i];
      if (!frame.camera_from_map) {
        gap = true;
        continue;
      }
      const Eigen::Vector2d at = scale(analysis_.plan(frame.camera_from_map->Center()));
      if (gap && previous) {
        const Eigen::Vector2d middle = 0.5 * (*previous + at);
        crosses += "M" + FixedOrDash(middle.x() - 4, 1) + " " + FixedOrDash(middle.y() - 4, 1) +
                   "l8 8m0-8l-8 8";
      }
      line +=
          (gap || !previous ? "M" : "L") + FixedOrDash(at.x(), 1) + " " + FixedOrDash(at.y(), 1);
      (IsWeak(i) ? weak : good).push_back(at);
      own[frame.name] = frame.camera_from_map->Center();
      previous = at;
      gap = false;
    }
    for (const vision::Keyframe& keyframe : database_.keyframes) {
      // Frames of two sessions may share a name.
      const auto found = own.find(keyframe.name);
      const Eigen::Vector3d center = keyframe.camera_from_map.Center();
      if (found == own.end() || (found->second - center).norm() > 1e-3 * analysis_.median_depth) {
        const Eigen::Vector2d at = scale(analysis_.plan(keyframe.camera_from_map.Center()));
        svg += "<circle cx=\"" + FixedOrDash(at.x(), 1) + "\" cy=\"" + FixedOrDash(at.y(), 1) +
               "\" r=\"2.5\" fill=\"#fff\" stroke=\"#5d6b75\"/>";
      }
    }
    svg += "<path d=\"" + line + "\" fill=\"none\" stroke=\"#2a7f76\" stroke-opacity=\".5\"/>\n";
    svg += Dots(good, kQualityColours[0], 4.0) + Dots(weak, kQualityColours[2], 5.0);
    svg += "<path d=\"" + crosses + "\" fill=\"none\" stroke=\"#a33b36\" stroke-width=\"2\"/>\n";
    return svg + PathEnds(scale);
  }

  // Names the first and the last keyframe.
  std::string PathEnds(const PlanScale& scale) const {
    if (database_.keyframes.size() < 2) {
      return {};
    }
    std::string svg;
    for (const auto* keyframe : {&database_.keyframes.front(), &database_.keyframes.back()}) {
      const Eigen::Vector2d at = scale(analysis_.plan(keyframe->camera_from_map.Center()));
      const bool right = at.x() > 0.6 * scale.width;
      svg += "<text x=\"" + FixedOrDash(at.x() + (right ? -7 : 7), 1) + "\" y=\"" +
             FixedOrDash(at.y() - 6, 1) + "\"" + (right ? " text-anchor=\"end\"" : "") + ">" +
             EscapeHtml(keyframe->name.substr(0, 40)) + "</text>\n";
    }
    return svg;
  }

  bool IsWeak(size_t frame) const {
    return std::any_of(analysis_.weak.begin(), analysis_.weak.end(), [&](const WeakFrames& weak) {
      return weak.first <= frame && frame <= weak.last;
    });
  }

  std::string PlaceSquares(const PlanScale& scale) const {
    std::string svg;
    const double side = analysis_.cell * scale.scale;
    for (const StandingPlace& place : analysis_.places) {
      const Eigen::Vector2d at = scale(place.center);
      const auto quality = static_cast<size_t>(QualityOf(place.prediction));
      const std::string error = std::isfinite(place.prediction.error_px)
                                    ? FixedOrDash(place.prediction.error_px, 2) + " px expected"
                                    : "no pose expected";
      svg += "<rect x=\"" + FixedOrDash(at.x() - 0.5 * side, 1) + "\" y=\"" +
             FixedOrDash(at.y() - 0.5 * side, 1) + "\" width=\"" + FixedOrDash(side, 1) +
             "\" height=\"" + FixedOrDash(side, 1) + "\" fill=\"" +
             std::string(kQualityFills[quality]) + "\"><title>" +
             FixedOrDash(place.prediction.matches, 0) + " points, " + error + "</title></rect>";
    }
    return svg + "\n";
  }

  void AddPlans() {
    if (database_.keyframes.empty()) {
      return;
    }
    const PlanScale scale = MakeScale();
    html_ += "<section><h2>The place from above</h2>\n<div class=\"two\">\n";
    html_ += "<figure><h3>What was seen, and from where</h3>\n" +
             PlanStart(scale, "Plan of the map's points and the camera path") + PointDots(scale) +
             PathDrawing(scale) + Ruler(scale) + "</svg>\n<div class=\"key\">" +
             KeyEntry("#7e8d96", "points seen from well apart") +
             KeyEntry("#c3ccd1", "points seen from nearly one direction") +
             KeyEntry(kQualityColours[0], "located frames") +
             KeyEntry(kQualityColours[2], "weak frames") +
             KeyEntry(kQualityColours[3], "missing frames") + "</div></figure>\n";
    html_ += "<figure><h3>Where a visitor will be located</h3>\n" +
             PlanStart(scale, "Plan of expected localisation quality") + PlaceSquares(scale) +
             PointDots(scale) + PathDrawing(scale) + Ruler(scale) + "</svg>\n<div class=\"key\">" +
             KeyEntry(kQualityFills[0], "well: within half a pixel") +
             KeyEntry(kQualityFills[1], "fairly: within 1.5 pixels") +
             KeyEntry(kQualityFills[2], "poorly") + KeyEntry(kQualityFills[3], "not at all") +
             "</div></figure>\n</div>\n";
    const std::array<size_t, 4> counts = PlacesOfQuality();
    html_ +=
        "<p class=\"small\">Predicted for each square from the points that a camera there "
        "would recognise when it looks where the film looked nearby, or 30 degrees to either "
        "side (the worst of these counts), and from how exactly "
        "they are seen (" +
        FixedOrDash(analysis_.noise_px, 2) +
        " px). Walls are known only through "
        "the directions that points were seen from. Squares:";
    for (size_t q = 0; q < counts.size(); ++q) {
      html_ += " " +
               Fact("places-" + std::string(kQualityNames[q]), std::to_string(counts[q]),
                    std::to_string(counts[q])) +
               " " + std::string(kQualityNames[q]) + (q + 1 < counts.size() ? "," : ".");
    }
    html_ += "</p></section>\n";
  }

  // ---------------------------------------------------------- pictures

  cv::Mat ImageOf(const std::string& name, int64_t frame_index) const {
    if (options_.frame_image) {
      if (cv::Mat image = options_.frame_image(frame_index); !image.empty()) {
        return image;
      }
    }
    // The latest session comes last, so the search runs backwards.
    const auto found =
        std::find_if(database_.keyframes.rbegin(), database_.keyframes.rend(),
                     [&](const vision::Keyframe& keyframe) {
                       return keyframe.name == name && keyframe.frame_index == frame_index;
                     });
    return found != database_.keyframes.rend() ? found->grey : cv::Mat();
  }

  void AddFilmed() {
    html_ += "<section><h2>What was filmed</h2>\n<div class=\"pictures\">\n";
    constexpr size_t kPictures = 5;
    // Shows located frames of this training, or keyframes if there are none.
    std::vector<std::pair<std::string, int64_t>> frames;
    for (const LocatedFrame& frame : report_.located) {
      frames.emplace_back(frame.name, frame.frame_index);
    }
    if (frames.empty()) {
      for (const vision::Keyframe& keyframe : database_.keyframes) {
        frames.emplace_back(keyframe.name, keyframe.frame_index);
      }
    }
    const size_t count = std::min(kPictures, frames.size());
    for (size_t i = 0; i < count; ++i) {
      const auto& [name, index] = frames[count < 2 ? 0 : i * (frames.size() - 1) / (count - 1)];
      const std::string picture = Picture(ImageOf(name, index), 360, name);
      if (!picture.empty()) {
        html_ +=
            "<figure>" + picture + "<figcaption>" + EscapeHtml(name) + "</figcaption></figure>\n";
      }
    }
    html_ += "</div>\n";
    AddStrip();
    html_ += "</section>\n";
  }

  // A strip of all frames in order: whether they were located, their sharpness and motion. In a
  // long recording a column stands for several frames and shows the worst one.
  void AddStrip() {
    const std::vector<FrameReport>& frames = report_.frame_reports;
    if (frames.size() < 2) {
      return;
    }
    constexpr size_t kColumns = 500;
    const size_t columns = std::min(kColumns, frames.size());
    double sharpest = 0.0;
    for (const FrameReport& frame : frames) {
      sharpest = std::max(sharpest, frame.motion.sharpness);
    }
    constexpr double kWidth = 1000.0;
    constexpr double kFastest = 0.12;  // Shift at the top of the drawing, share of the diagonal.
    const double width = kWidth / static_cast<double>(columns);
    std::array<std::string, 3> located;  // Paths of good, weak and missing frames.
    std::string sharp;
    std::string motion;
    for (size_t c = 0; c < columns; ++c) {
      const size_t begin = c * frames.size() / columns;
      const size_t end = (c + 1) * frames.size() / columns;
      size_t state = 0;
      double sharpness = sharpest;
      double shift = 0.0;
      for (size_t i = begin; i < end; ++i) {
        state = std::max<size_t>(state, !frames[i].camera_from_map ? 2 : IsWeak(i) ? 1 : 0);
        sharpness = std::min(sharpness, frames[i].motion.sharpness);
        shift = std::max(shift, frames[i].motion.shift);
      }
      const double x = static_cast<double>(c) * width;
      const auto bar = [&](double y, double height) {
        return "M" + FixedOrDash(x, 1) + " " + FixedOrDash(y, 1) + "h" +
               FixedOrDash(width + 0.1, 1) + "v" + FixedOrDash(-height, 1) + "h-" +
               FixedOrDash(width + 0.1, 1) + "z";
      };
      located[state] += bar(16.0, 16.0);
      sharp += bar(66.0, sharpest > 0.0 ? 40.0 * std::sqrt(sharpness / sharpest) : 0.0);
      motion += bar(116.0, 40.0 * std::min(1.0, shift / kFastest));
    }
    html_ +=
        "<svg viewBox=\"0 0 1080 136\" role=\"img\" aria-label=\"Frames from first to last\" "
        "style=\"margin-top:18px\">\n";
    for (size_t state = 0; state < located.size(); ++state) {
      static constexpr std::array<size_t, 3> kColour = {0, 2, 3};
      html_ += "<path d=\"" + located[state] + "\" fill=\"" +
               std::string(kQualityColours[kColour[state]]) + "\"/>\n";
    }
    html_ += "<path d=\"" + sharp + "\" fill=\"#8fa3ad\"/>\n<path d=\"" + motion +
             "\" fill=\"#b9a7c9\"/>\n";
    html_ +=
        "<text x=\"1008\" y=\"13\">located</text><text x=\"1008\" y=\"63\">sharp</text>"
        "<text x=\"1008\" y=\"113\">motion</text>\n";
    html_ += "<text x=\"0\" y=\"132\">" + EscapeHtml(frames.front().name.substr(0, 40)) +
             "</text><text x=\"1000\" y=\"132\" text-anchor=\"end\">" +
             EscapeHtml(frames.back().name.substr(0, 40)) + "</text></svg>\n";
  }

  void AddWeakFrames() {
    html_ += "<section><h2>Weak frames</h2>\n";
    size_t missing = 0;
    size_t hardly = 0;
    for (const WeakFrames& weak : analysis_.weak) {
      (weak.located ? hardly : missing) += weak.last - weak.first + 1;
    }
    if (analysis_.weak.empty()) {
      html_ += "<p>None: every frame was located by enough points.</p></section>\n";
      return;
    }
    html_ += "<p>" + Fact("missing", std::to_string(missing), std::to_string(missing)) +
             " frames were not located, " +
             Fact("weak", std::to_string(hardly), std::to_string(hardly)) +
             " hang on few points.</p>\n<div class=\"weak\">\n";
    constexpr size_t kMost = 12;
    // Shows the longest stretches, in the order of the recording.
    std::vector<size_t> order(analysis_.weak.size());
    for (size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      const auto length = [&](size_t i) {
        return analysis_.weak[i].last - analysis_.weak[i].first;
      };
      return length(a) > length(b);
    });
    order.resize(std::min(kMost, order.size()));
    std::sort(order.begin(), order.end());
    for (const size_t i : order) {
      AddWeakStretch(analysis_.weak[i]);
    }
    html_ += "</div>\n";
    if (analysis_.weak.size() > kMost) {
      html_ += "<p class=\"small\">and " + std::to_string(analysis_.weak.size() - kMost) +
               " shorter stretches.</p>\n";
    }
    html_ += "</section>\n";
  }

  void AddWeakStretch(const WeakFrames& weak) {
    const FrameReport& first = report_.frame_reports[weak.first];
    const FrameReport& last = report_.frame_reports[weak.last];
    const FrameReport& middle = report_.frame_reports[(weak.first + weak.last) / 2];
    html_ += "<figure>" + Picture(ImageOf(middle.name, middle.frame_index), 300, middle.name) +
             "<figcaption><strong>" + EscapeHtml(first.name) +
             (weak.first == weak.last ? "" : " to " + EscapeHtml(last.name)) +
             "</strong><br><span class=\"tag\" style=\"color:" +
             std::string(kQualityColours[weak.located ? 2 : 3]) + "\">" +
             (weak.located ? "" : "not located: ") + Title(weak.reason).English() + "</span><br>" +
             std::to_string(middle.features) + " features, " + std::to_string(middle.observations) +
             " points of the map, moved " + FixedOrDash(100.0 * middle.motion.shift, 1) +
             " % of the image.<br>" + Remedy(weak.reason).English() + ".</figcaption></figure>\n";
  }

  // ---------------------------------------------------------- charts

  std::string Bars(const Histogram& histogram, std::string_view name) const {
    size_t most = 1;
    for (const size_t count : histogram.counts) {
      most = std::max(most, count);
    }
    const double width = 320.0 / static_cast<double>(histogram.counts.size());
    std::string svg = "<svg viewBox=\"0 0 320 150\" role=\"img\" aria-label=\"" +
                      std::string(name) + "\" data-histogram=\"" + std::string(name) + "\">\n";
    for (size_t i = 0; i < histogram.counts.size(); ++i) {
      const double height =
          120.0 * static_cast<double>(histogram.counts[i]) / static_cast<double>(most);
      const double x = static_cast<double>(i) * width;
      svg += "<rect x=\"" + FixedOrDash(x + 1, 1) + "\" y=\"" + FixedOrDash(125.0 - height, 1) +
             "\" width=\"" + FixedOrDash(width - 2, 1) + "\" height=\"" + FixedOrDash(height, 1) +
             "\" fill=\"#6d9ea3\" data-count=\"" + std::to_string(histogram.counts[i]) +
             "\"><title>" + histogram.labels[i] + ": " + std::to_string(histogram.counts[i]) +
             "</title></rect><text x=\"" + FixedOrDash(x + 0.5 * width, 1) +
             "\" y=\"140\" text-anchor=\"middle\" style=\"font-size:" +
             (histogram.labels[i].size() * histogram.labels.size() > 40 ? "9px" : "10px") + "\">" +
             histogram.labels[i] + "</text>\n";
    }
    return svg + "<path d=\"M0 125.5h320\" stroke=\"#5d6b75\"/></svg>\n";
  }

  void AddHistograms() {
    html_ += "<section><h2>How exactly the points are known</h2>\n<div class=\"three\">\n";
    html_ +=
        "<figure><h3>Reprojection error</h3>" + Bars(analysis_.reprojection, "reprojection") +
        "<figcaption>observations by their distance from the point's projection, up to this many "
        "pixels</figcaption></figure>\n";
    html_ += "<figure><h3>Track length</h3>" + Bars(analysis_.track_lengths, "tracks") +
             "<figcaption>points by how many images saw them</figcaption></figure>\n";
    html_ += "<figure><h3>Parallax</h3>" + Bars(analysis_.parallax, "parallax") +
             "<figcaption>points by the widest angle that they were seen from, in degrees: above "
             "8 their depth is certain</figcaption></figure>\n";
    html_ += "</div></section>\n";
  }

  void AddSessions() {
    std::vector<size_t> keyframes(32, 0);
    std::vector<size_t> points(32, 0);
    std::vector<size_t> only(32, 0);
    for (const vision::Keyframe& keyframe : database_.keyframes) {
      ++keyframes[keyframe.session % 32];
    }
    for (const uint32_t mask : database_.session_masks) {
      for (size_t session = 0; session < 32; ++session) {
        points[session] += mask >> session & 1u;
        only[session] += mask == 1u << session ? 1 : 0;
      }
    }
    html_ +=
        "<section><h2>Sessions and light</h2>\n<table><tr><th>session</th><th>keyframes</th>"
        "<th>points that it saw</th><th>that only it saw</th></tr>\n";
    for (size_t session = 0; session < 32; ++session) {
      if (keyframes[session] > 0 || points[session] > 0) {
        html_ += "<tr data-session=\"" + std::to_string(session) + "\"><td>" +
                 std::to_string(session) + "</td><td>" + std::to_string(keyframes[session]) +
                 "</td><td>" + std::to_string(points[session]) + "</td><td>" +
                 std::to_string(only[session]) + "</td></tr>\n";
      }
    }
    html_ += "</table>\n";
    AddGains();
    html_ += "</section>\n";
  }

  // Draws the gains of the keyframes in stops.
  void AddGains() {
    if (database_.colours.empty() || database_.keyframes.size() < 2) {
      html_ +=
          "<p class=\"small\">The map has no colours, so changes of exposure are not "
          "known.</p>\n";
      return;
    }
    double reach = 1.0;
    for (const vision::Keyframe& keyframe : database_.keyframes) {
      for (const float gain : keyframe.gain) {
        reach = std::max(reach, std::ceil(std::abs(std::log2(std::max(1e-6, double{gain})))));
      }
    }
    static constexpr std::array<std::string_view, 3> kColours = {"#b5544a", "#5c8f5a", "#4a77a8"};
    static constexpr std::array<std::string_view, 3> kDashes = {"", "6 2", "2 2"};
    html_ +=
        "<figure><h3>Exposure and white balance</h3><svg viewBox=\"0 0 1080 170\" "
        "role=\"img\" aria-label=\"Gains of the keyframes\">\n"
        "<path d=\"M0 75.5h1000\" stroke=\"#d9dfe2\"/>";
    const double count = static_cast<double>(database_.keyframes.size() - 1);
    for (size_t channel = 0; channel < 3; ++channel) {
      std::string path;
      for (size_t k = 0; k < database_.keyframes.size(); ++k) {
        const double stops =
            std::log2(std::max(1e-6, double{database_.keyframes[k].gain[channel]}));
        path += (k == 0 ? "M" : "L") + FixedOrDash(1000.0 * static_cast<double>(k) / count, 1) +
                " " + FixedOrDash(75.0 - 70.0 * stops / reach, 1);
      }
      html_ += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + std::string(kColours[channel]) +
               "\" stroke-width=\"1.5\" stroke-dasharray=\"" + std::string(kDashes[channel]) +
               "\"/>\n";
    }
    html_ +=
        "<text x=\"1008\" y=\"12\">+" + FixedOrDash(reach, 0) +
        " stops</text><text x=\"1008\" y=\"79\">0</text><text x=\"1008\" y=\"148\">-" +
        FixedOrDash(reach, 0) + "</text><text x=\"0\" y=\"165\">" +
        EscapeHtml(database_.keyframes.front().name.substr(0, 40)) +
        "</text><text x=\"1000\" y=\"165\" text-anchor=\"end\">" +
        EscapeHtml(database_.keyframes.back().name.substr(0, 40)) +
        "</text></svg>\n<div class=\"key\">" + KeyEntry(kColours[0], "red") +
        KeyEntry(kColours[1], "green") + KeyEntry(kColours[2], "blue") +
        "<span>brightness of each keyframe against the map's reference</span></div></figure>\n";
  }

  // ---------------------------------------------------------- camera and training

  static std::string Row(std::string_view what, const std::string& value) {
    return "<tr><th>" + std::string(what) + "</th><td>" + value + "</td></tr>\n";
  }

  void AddFacts() {
    const geometry::CameraModel& camera = database_.camera;
    html_ += "<section><h2>Camera and training</h2>\n<div class=\"two\">\n<table>\n";
    html_ += Row("image",
                 std::to_string(camera.width) + " x " + std::to_string(camera.height) + " pixels");
    std::string focal =
        Fact("focal", FixedOrDash(camera.Focal(), 4), FixedOrDash(camera.Focal(), 1)) + " px";
    if (report_.intrinsics_estimated) {
      focal += ", estimated, standard deviation " +
               Fact("focal-deviation", FixedOrDash(report_.focal_deviation_px, 4),
                    FixedOrDash(report_.focal_deviation_px, 2)) +
               " px (" + FixedOrDash(100.0 * report_.focal_deviation_px / camera.Focal(), 2) +
               " %)";
    } else {
      focal += ", given";
    }
    html_ += Row("focal length", focal);
    html_ +=
        Row("field of view",
            FixedOrDash(360.0 / std::numbers::pi * std::atan(0.5 * camera.width / camera.fx), 0) +
                " degrees across");
    html_ += Row("principal point", FixedOrDash(camera.cx, 1) + ", " + FixedOrDash(camera.cy, 1));
    html_ += Row("distortion", "k1 " + FixedOrDash(camera.k1, 4) + ", k2 " +
                                   FixedOrDash(camera.k2, 4) + ", p1 " + FixedOrDash(camera.p1, 4) +
                                   ", p2 " + FixedOrDash(camera.p2, 4));
    html_ += "</table>\n<table>\n";
    if (options_.database_bytes > 0) {
      html_ += Row("size on disk", Fact("bytes", std::to_string(options_.database_bytes),
                                        Size(options_.database_bytes)));
    }
    html_ +=
        Row("of it descriptors", Size(database_.descriptors.size() * vision::kDescriptorSize) +
                                     " (" + std::to_string(database_.descriptors.size()) + ")");
    double seconds = 0.0;
    for (const auto& [step, duration] : report_.seconds) {
      html_ += Row(EscapeHtml(step), FixedOrDash(duration, 1) + " s");
      seconds += duration;
    }
    if (!report_.seconds.empty()) {
      html_ += Row("training altogether", FixedOrDash(seconds, 1) + " s");
    }
    html_ += "</table>\n</div></section>\n";
  }

  const TrainReport& report_;
  const vision::SceneDatabase& database_;
  const CaptureReportOptions& options_;
  CaptureAnalysis analysis_;
  std::string html_;
};

}  // namespace

std::function<cv::Mat(int64_t)> FrameImagesOf(capture::FrameSource& source) {
  return [&source](int64_t frame_index) -> cv::Mat {
    if (!source.Seek(frame_index).ok()) {
      return {};
    }
    const Result<std::optional<geometry::Frame>> frame = source.Next();
    return frame.ok() && *frame && (*frame)->index == frame_index ? (*frame)->bgr.clone()
                                                                  : cv::Mat();
  };
}

std::string FormatCaptureReport(const TrainReport& report,
                                const vision::SceneDatabase& database,
                                const CaptureReportOptions& options) {
  return Page(report, database, options).Format();
}

Status WriteCaptureReport(const TrainReport& report,
                          const vision::SceneDatabase& database,
                          const std::filesystem::path& file,
                          const CaptureReportOptions& options) {
  if (const Status status = database.Validate(); !status.ok()) {
    return status.At(file.string());
  }
  return WriteFileAtomically(file,
                             std::string_view(FormatCaptureReport(report, database, options)));
}

}  // namespace lararium::train
