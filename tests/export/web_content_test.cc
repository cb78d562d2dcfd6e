#include "editor/export/web_content.h"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "editor/export/opus_sound.h"
#include "shared/human/human.h"
#include "shared/image/decode.h"
#include "shared/image/encode.h"
#include "shared/stage/object_use.h"
#include "shared/stage/prop.h"
#include "shared/vision/scene_database.h"
#include "tests/audio/test_sounds.h"
#include "tests/human/rich_human.h"
#include "tests/stage/test_props.h"
#include "tests/support/synthetic_world.h"

namespace lararium::exporter {
namespace {

using ::testing::HasSubstr;

std::vector<float> Decode(std::span<const std::byte> sound) {
  auto reader = audio::SoundReader::Open(sound, "sound");
  EXPECT_TRUE(reader.ok()) << reader.message();
  std::vector<int16_t> samples(static_cast<size_t>(reader->frames() * reader->channels()));
  EXPECT_EQ(reader->Read(samples), static_cast<size_t>(reader->frames()));
  return {samples.begin(), samples.end()};
}

// Correlation of two sounds of one rate, the second one `lag` samples later.
double Correlation(std::span<const float> a, std::span<const float> b, int lag) {
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (size_t i = 500; i + 500 < std::min(a.size(), b.size()); ++i) {
    const float other = b[static_cast<size_t>(static_cast<int>(i) + lag)];
    ab += a[i] * other;
    aa += a[i] * a[i];
    bb += other * other;
  }
  return ab / std::sqrt(aa * bb);
}

TEST(OpusSound, SoundsAlikeAtTheSameTime) {
  // Two tones that swell, so that no shift looks like another.
  const auto voice = [](double t) {
    return 0.2 * std::sin(2000.0 * t) * (1.0 + std::sin(7.0 * t)) + 0.1 * std::sin(5000.0 * t);
  };
  for (const int rate : {24'000, 48'000}) {
    const std::vector<float> samples = test::Make(2.0, voice, rate);
    const auto flac = test::Encode(samples, 1, rate, test::Coding::kFlac);
    const auto opus = EncodeOpus(flac, "line");
    ASSERT_TRUE(opus.ok()) << opus.message();
    const double kilobits = static_cast<double>(opus->size()) * 8.0 / 2.0 / 1000.0;
    EXPECT_LT(kilobits, rate == 24'000 ? 40.0 : 80.0);
    EXPECT_EQ(*opus, *EncodeOpus(flac, "line")) << "equal sounds are equal files";
    const std::vector<float> decoded = Decode(*opus);
    ASSERT_EQ(decoded.size(), samples.size()) << rate;
    const double here = Correlation(samples, decoded, 0);
    EXPECT_GT(here, 0.98) << rate;
    EXPECT_GT(here, Correlation(samples, decoded, -2)) << rate;
    EXPECT_GT(here, Correlation(samples, decoded, 2)) << rate;
  }
}

TEST(OpusSound, ConvertsRatesThatOpusLacks) {
  const auto tone = [](double t) { return 0.3 * std::sin(3000.0 * t); };
  const auto voice = EncodeOpus(test::Encode(test::Make(1.5, tone, 22'050), 1, 22'050), "line");
  ASSERT_TRUE(voice.ok()) << voice.message();
  const auto reader = audio::SoundReader::Open(*voice, "line");
  EXPECT_EQ(reader->rate(), 24'000);
  EXPECT_NEAR(reader->seconds(), 1.5, 0.001);
  EXPECT_GT(Correlation(test::Make(1.5, tone, 24'000), Decode(*voice), 0), 0.98);
  const auto stereo = EncodeOpus(test::Encode(test::Tone(1.0, 440.0), 2, 44'100), "sound");
  ASSERT_TRUE(stereo.ok()) << stereo.message();
  EXPECT_EQ(audio::SoundReader::Open(*stereo, "sound")->channels(), 2);
  EXPECT_THAT(EncodeOpus(std::as_bytes(std::span("no sound")), "sound 'x'").message(),
              HasSubstr("sound 'x'"));
}

TEST(WebContent, LeavesOutWhatAPageDoesNotNeed) {
  human::Human human = human::RichHuman();
  human.meshes[0].coarser = {{0.001f, {0, 1, 2}}, {0.5f, {}}};
  // A texel of 512 is 0.4 mm.
  human.meshes[0].positions = {{0, 1, 0}, {0.2f, 1, 0}, {0, 1.2f, 0}, {0.2f, 1.2f, 0}};
  human.meshes[0].uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  cv::Mat hair(512, 512, CV_8UC4, cv::Scalar(20, 40, 80, 0));
  hair.rowRange(0, 256).setTo(cv::Scalar(20, 40, 80, 255));
  for (auto& texture : human.textures) {
    texture = std::make_shared<const human::Texture>(
        human::Texture{texture->name, *image::EncodePng(hair)});
  }
  stage::Prop cup = test::MakeCup();
  cup.parts[1].parent_from_part.rotation = glm::angleAxis(0.6f, glm::vec3(0.0f, 0.6f, 0.8f));
  // A level without the last vertex, which is 2 mm from the full detail.
  cup.parts[0].meshes[0].coarser = {{0.002f, {0, 2, 1, 1, 2, 3, 4, 5, 6}}, {0.02f, {0, 2, 1}}};
  // A vertex that is inside.
  stage::PropMesh& side_of_cup = cup.parts[0].meshes[0];
  side_of_cup.positions.emplace_back(0.01f, 0.05f, 0.01f);
  side_of_cup.normals.emplace_back(0.0f, 1.0f, 0.0f);
  side_of_cup.albedo.emplace_back(0.5f);
  ExportContent content;
  content.cast = {{"keeper", human::SerializeHuman(human)}};
  content.objects = {{"cup", stage::SerializeProp(cup), {}}};
  SpokenContent& line = content.lines.emplace_back();
  line.sound = test::Encode(test::Make(
                                1.0, [](double t) { return std::sin(900.0 * t); }, 22'050),
                            1, 22'050, test::Coding::kFlac);
  const size_t line_bytes = line.sound.size();
  content.lines.emplace_back();  // A line without a sound.
  content.sounds = {test::Sound("bell", test::Encode(test::Noise(1.0), 1))};
  const size_t bell_bytes = content.sounds[0].bytes.size();
  NoProgress progress;
  const Status status = ReduceForWeb(content, progress);
  ASSERT_TRUE(status.ok()) << status.message();

  const auto person = human::ParseHuman(content.cast[0].human, "keeper");
  ASSERT_TRUE(person.ok()) << person.message();
  EXPECT_EQ(person->meshes[0].positions.size(), 3u);
  EXPECT_EQ(person->meshes[0].error, 0.001f)
      << "as if a player had read the whole file at this detail";
  ASSERT_FALSE(person->textures.empty());
  const auto smaller =
      image::DecodeImage(person->textures[0]->encoded, image::Channels::kBgra, "hair");
  ASSERT_TRUE(smaller.ok()) << smaller.message();
  EXPECT_EQ(smaller->size(), cv::Size(256, 256));
  EXPECT_EQ(smaller->at<cv::Vec4b>(10, 10), cv::Vec4b(20, 40, 80, 255));
  EXPECT_EQ(smaller->at<cv::Vec4b>(200, 10)[3], 0);
  EXPECT_EQ(person->skeleton.names, human.skeleton.names);
  // What the drama needs of a person comes apart.
  ASSERT_FALSE(human.clips.empty());
  EXPECT_TRUE(person->clips.empty());
  const auto motion = human::ParseHuman(content.cast[0].motion, "keeper");
  ASSERT_TRUE(motion.ok()) << motion.message();
  EXPECT_TRUE(motion->meshes.empty() && motion->light.empty() && motion->textures.empty());
  EXPECT_EQ(motion->skeleton.names, human.skeleton.names);
  EXPECT_EQ(motion->clips.size(), human.clips.size());
  EXPECT_EQ(motion->face.size(), human.face.size());
  EXPECT_EQ(motion->morphs.size(), human.morphs.size());
  // Numbers are rounded by less than can be seen.
  const human::SkinnedMesh& mesh = person->meshes[0];
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    EXPECT_LT(glm::distance(mesh.positions[v], human.meshes[0].positions[v]), 0.0003f);
    EXPECT_LT(glm::distance(mesh.normals[v], human.meshes[0].normals[v]), 0.005f);
    EXPECT_LT(glm::distance(mesh.albedo[v], human.meshes[0].albedo[v]), 0.015f);
    EXPECT_LT(glm::distance(mesh.uvs[v], human.meshes[0].uvs[v]), 0.0004f);
  }
  // The vertices that are left are lit as before, to half a step and to degree 2.
  const auto read = human::ParseHuman(human::SerializeHuman(human), "keeper", kWebDetail);
  const auto& before = read->light.meshes[0].coefficients;
  const auto& after = person->light.meshes[0].coefficients;
  const auto count = static_cast<size_t>(read->light.count);
  ASSERT_EQ(person->light.count, 9);
  ASSERT_EQ(before.size() * 9, after.size() * count);
  for (size_t i = 0; i < after.size(); ++i) {
    const int value = before[i / 9 * count + i % 9];
    const int step = i % 9 < 4 ? 8 : 16;
    EXPECT_EQ(after[i] % step, 0);
    EXPECT_LE(std::abs(value - after[i]), std::abs(value) > 127 - step / 2 ? step - 1 : step / 2);
  }
  const auto drawn = stage::ParseProp(content.objects[0].prop, "cup");
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  ASSERT_EQ(drawn->parts.size(), cup.parts.size());
  const stage::PropMesh& side = drawn->parts[0].meshes[0];
  EXPECT_LE(side.positions.size(), 8u);
  EXPECT_EQ(side.indices, cup.parts[0].meshes[0].coarser[0].indices);
  EXPECT_EQ(side.coarser.size(), 1u);
  // The drama is that of the whole object.
  const auto whole = stage::ObjectModel::Create(cup, "");
  const auto extent =
      stage::ObjectModel::Create(*stage::ParseProp(content.objects[0].extent, "cup"), "");
  ASSERT_TRUE(whole.ok() && extent.ok()) << extent.message();
  const auto cut = stage::ObjectModel::Create(*drawn, "");
  ASSERT_TRUE(cut.ok());
  EXPECT_EQ((*cut)->lower(), (*whole)->lower());
  EXPECT_EQ((*cut)->upper(), (*whole)->upper());
  EXPECT_EQ((*extent)->lower(), (*whole)->lower());
  EXPECT_EQ((*extent)->upper(), (*whole)->upper());
  for (int part = 0; part < static_cast<int>(cup.parts.size()); ++part) {
    EXPECT_EQ((*extent)->bounds(part).lower, (*whole)->bounds(part).lower);
    EXPECT_EQ((*extent)->bounds(part).upper, (*whole)->bounds(part).upper);
  }
  EXPECT_EQ((*extent)->use().states, (*whole)->use().states);
  EXPECT_TRUE((*extent)->prop().light.empty() && (*extent)->prop().textures.empty());
  EXPECT_LT(content.lines[0].sound.size(), line_bytes);
  EXPECT_TRUE(content.lines[1].sound.empty());
  EXPECT_LT(content.sounds[0].bytes.size(), bell_bytes);
}

TEST(WebContent, MapsKeepTheirPointsInNumbersThatPackWell) {
  ExportContent content;
  content.places.emplace_back().scene =
      vision::SerializeSceneDatabase(test::MakeSceneDatabase(test::MakeSyntheticWorld({})));
  content.caption_metrics = "{}";
  const auto before = vision::ParseSceneDatabase(content.places[0].scene, "place");
  NoProgress progress;
  const Status status = ReduceForWeb(content, progress);
  ASSERT_TRUE(status.ok()) << status.message();
  EXPECT_TRUE(content.caption_metrics.empty());
  const auto after = vision::ParseSceneDatabase(content.places[0].scene, "place");
  ASSERT_TRUE(after.ok()) << after.message();
  EXPECT_EQ(after->points, before->points);
  ASSERT_EQ(after->descriptors.size(), before->descriptors.size());
  ASSERT_FALSE(after->descriptors.empty());
  for (size_t d = 0; d < after->descriptors.size(); ++d) {
    for (size_t i = 0; i < after->descriptors[d].size(); ++i) {
      EXPECT_EQ(after->descriptors[d][i] % 16, 0);
      EXPECT_LE(std::abs(after->descriptors[d][i] - before->descriptors[d][i]), 15);
    }
  }
  EXPECT_EQ(after->observations.size(), before->observations.size());
  EXPECT_EQ(after->keyframes.size(), before->keyframes.size());
}

}  // namespace
}  // namespace lararium::exporter
