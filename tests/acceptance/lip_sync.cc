// Compares mouths with voices: plays every line of a bundle through the show and the mixer, and
// correlates the opening of the lips with the loudness of the exported sound.
//
//   lip_sync SHOW.larshow ACTOR [LANGUAGE]
//
// Lips: the vertex of the face that moves furthest down, over all lines; its distance below its
// position at rest. Sound: root mean square of 33 ms around each moment, to the power of 0.6
// (loudness, Stevens 1955). The lag is that of the lips: positive if they move after the sound.
// Prints one line of JSON for each line of the drama.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "shared/audio/sound_track.h"
#include "shared/core/json.h"
#include "shared/show/show.h"

namespace lararium {
namespace {

constexpr double kFramesPerSecond = 60.0;
constexpr double kBegin = 0.5;     // Start of a line, seconds.
constexpr double kPause = 0.5;     // Pause after a line, seconds.
constexpr double kWindow = 0.033;  // Window of loudness, seconds.
constexpr int kMostLag = 12;       // Frames.

// An actor stands a metre in front of the camera and speaks.
std::string DramaOf(const std::string& actor, const std::string& line) {
  return "local who = actor('" + actor +
         "')\nfunction main()\n who:place{x = 0, y = 0, z = 0, heading = 180}\n"
         " who:attention(false) who:look_at(false) wait(0.5) who:say('" +
         line + "')\nend\n";
}

vision::TrackedFrame CloseUp(const geometry::Similarity3& map_from_stage) {
  vision::TrackedFrame tracked;
  tracked.state = vision::TrackState::kTracking;
  tracked.camera.width = 640;
  tracked.camera.height = 480;
  tracked.camera.fx = tracked.camera.fy = 600.0;
  tracked.camera.cx = 320.0;
  tracked.camera.cy = 240.0;
  // The camera is at (0, 1.5, 1) and looks along -Z. A pose in the map is rigid, but in the map's
  // scale.
  const Eigen::Quaterniond camera_from_stage(0.0, 1.0, 0.0, 0.0);
  const Eigen::Quaterniond rotation = camera_from_stage * map_from_stage.rotation.conjugate();
  const Eigen::Vector3d centre = map_from_stage * Eigen::Vector3d(0.0, 1.5, 1.0);
  tracked.camera_from_map = geometry::Rigid3{rotation, -(rotation * centre)};
  return tracked;
}

struct Performance {
  std::vector<std::vector<glm::vec3>> vertices;  // Vertices of the moving meshes in each frame.
  std::vector<float> sound;                      // Mono, 48000 samples a second.
};

Result<Performance> Perform(show::ShowContent content,
                            const std::string& actor,
                            const std::string& line,
                            double seconds,
                            Log& log) {
  content.drama = DramaOf(actor, line);
  const geometry::Similarity3 map_from_stage = content.places[0].stage.map_from_stage;
  LARARIUM_ASSIGN_OR_RETURN(const auto show, show::Show::Create(std::move(content), {}, log));
  Performance performance;
  LARARIUM_ASSIGN_OR_RETURN(
      const auto track,
      audio::SoundTrack::Create(show->sounds(), false, [&](std::span<const float> stereo) {
        for (size_t i = 0; i + 1 < stereo.size(); i += 2) {
          performance.sound.push_back(0.5f * (stereo[i] + stereo[i + 1]));
        }
        return Status();
      }));
  show::StagedFrame staged;
  const int frames = static_cast<int>((kBegin + seconds + kPause) * kFramesPerSecond);
  for (int frame = 0; frame < frames; ++frame) {
    vision::TrackedFrame tracked = CloseUp(map_from_stage);
    tracked.frame.capture_time = frame / kFramesPerSecond;
    show->StageFrame(std::move(tracked), frame / kFramesPerSecond, staged);
    std::erase_if(staged.sound.voices,
                  [](const audio::Voice& voice) { return voice.bus != audio::Bus::kSpeech; });
    LARARIUM_RETURN_IF_ERROR(track->RenderUntil(staged.sound));
    std::vector<glm::vec3>& vertices = performance.vertices.emplace_back();
    for (const show::StagedMesh& mesh : staged.people.meshes) {
      if (!mesh.mesh.posed) {
        const auto begin = staged.people.positions.begin() + mesh.vertex_begin;
        vertices.insert(vertices.end(), begin, begin + mesh.vertex_count);
      }
    }
  }
  LARARIUM_RETURN_IF_ERROR(track->RenderOn(kWindow));
  if (!show->drama().errors().empty()) {
    return Status::Error(line, show->drama().errors()[0].message);
  }
  return performance;
}

// Opening of the lips, metres. Meshes move only while something animates them: frames without
// vertices are at rest.
std::vector<double> Opening(const Performance& performance) {
  size_t count = 0;
  for (const auto& vertices : performance.vertices) {
    count = std::max(count, vertices.size());
  }
  std::vector<float> highest(count, -1e9f), lowest(count, 1e9f);
  for (const auto& vertices : performance.vertices) {
    for (size_t i = 0; vertices.size() == count && i < count; ++i) {
      highest[i] = std::max(highest[i], vertices[i].y);
      lowest[i] = std::min(lowest[i], vertices[i].y);
    }
  }
  size_t lip = 0;
  for (size_t i = 0; i < count; ++i) {
    lip = highest[i] - lowest[i] > highest[lip] - lowest[lip] ? i : lip;
  }
  std::vector<double> opening;
  for (const auto& vertices : performance.vertices) {
    opening.push_back(count > 0 && vertices.size() == count
                          ? static_cast<double>(highest[lip] - vertices[lip].y)
                          : 0.0);
  }
  return opening;
}

std::vector<double> Loudness(const std::vector<float>& sound, size_t frames) {
  std::vector<double> loudness;
  for (size_t frame = 0; frame < frames; ++frame) {
    const double middle = static_cast<double>(frame) / kFramesPerSecond;
    const auto at = [&](double t) {
      return static_cast<size_t>(
          std::clamp(t * audio::Mixer::kRate, 0.0, static_cast<double>(sound.size())));
    };
    double sum = 0.0;
    for (size_t i = at(middle - 0.5 * kWindow); i < at(middle + 0.5 * kWindow); ++i) {
      sum += static_cast<double>(sound[i]) * static_cast<double>(sound[i]);
    }
    loudness.push_back(std::pow(std::sqrt(sum / (kWindow * audio::Mixer::kRate)), 0.6));
  }
  return loudness;
}

// Correlation of a[i + lag] and b[i].
double Correlation(const std::vector<double>& a, const std::vector<double>& b, int lag) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int i = 0; i < static_cast<int>(b.size()); ++i) {
    if (i + lag < 0 || i + lag >= static_cast<int>(a.size())) {
      continue;
    }
    const double x = a[static_cast<size_t>(i + lag)], y = b[static_cast<size_t>(i)];
    n += 1, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  const double variance = (saa - sa * sa / n) * (sbb - sb * sb / n);
  return variance > 0.0 ? (sab - sa * sb / n) / std::sqrt(variance) : 0.0;
}

Status Measure(const show::ShowContent& content, const std::string& actor, Log& log) {
  for (const show::Speech& line : content.speech) {
    if (line.sound.empty()) {
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(
        const Performance performance,
        Perform(content, actor, line.name, static_cast<double>(line.visemes.duration), log));
    const std::vector<double> opening = Opening(performance);
    const std::vector<double> loudness = Loudness(performance.sound, opening.size());
    int best = 0;
    for (int lag = -kMostLag; lag <= kMostLag; ++lag) {
      best =
          Correlation(opening, loudness, lag) > Correlation(opening, loudness, best) ? lag : best;
    }
    const Json json = {{"line", line.name},
                       {"seconds", line.visemes.duration},
                       {"opening_mm", 1e3 * *std::max_element(opening.begin(), opening.end())},
                       {"correlation", Correlation(opening, loudness, 0)},
                       {"best_correlation", Correlation(opening, loudness, best)},
                       {"lag_ms", 1e3 * best / kFramesPerSecond}};
    std::printf("%s\n", json.dump().c_str());
  }
  return Status();
}

Status Run(const std::string& file, const std::string& actor, const std::string& language) {
  const auto log = MakeSilentLog();
  LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(file));
  LARARIUM_ASSIGN_OR_RETURN(const show::ShowContent content,
                            show::LoadShowContent(bundle, {}, {language, "off"}));
  return Measure(content, actor, *log);
}

}  // namespace
}  // namespace lararium

int main(int argc, char** argv) {
  if (argc < 3 || argc > 4) {
    std::fprintf(stderr, "usage: lip_sync SHOW.larshow ACTOR [LANGUAGE]\n");
    return 2;
  }
  const lararium::Status status = lararium::Run(argv[1], argv[2], argc > 3 ? argv[3] : "");
  if (!status.ok()) {
    std::fprintf(stderr, "%s\n", status.message().c_str());
  }
  return status.ok() ? 0 : 1;
}
