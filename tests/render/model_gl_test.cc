#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <thread>

#include "shared/core/srgb.h"
#include "shared/core/units.h"
#include "shared/geometry/glm_convert.h"
#include "shared/human/skinning.h"
#include "shared/light/glossy_map.h"
#include "shared/render/clip_space.h"
#include "shared/render/detail.h"
#include "shared/render/renderer.h"
#include "tests/golden/compare_images.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/test_people.h"
#include "tests/support/png.h"

namespace lararium::render {
namespace {

using ::testing::HasSubstr;
const glm::mat4 kNoMotion(1.0f);

human::Texture Encode(const cv::Mat& image) { return {"texture", test::Png(image)}; }

// A square of 2 m x 2 m that faces +Z, with u to the right and v downwards.
human::SkinnedMesh Square() {
  human::SkinnedMesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.normals.assign(4, glm::vec3(0, 0, 1));
  mesh.albedo.assign(4, glm::vec3(1.0f));
  mesh.joints.assign(4, {0, 0, 0, 0});
  mesh.weights.assign(4, glm::vec4(1, 0, 0, 0));
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

human::Human Textured(const cv::Mat& image, const human::Material& material) {
  human::Human human = MakeHuman(Square(), 1);
  human.textures = {std::make_shared<const human::Texture>(Encode(image))};
  human.materials = {material};
  human.meshes[0].material = 0;
  return human;
}

// Irradiance pi from all directions, so that the visible radiance equals the albedo.
light::ShRgb EvenLight() {
  light::ShRgb light = {};
  light[0] = glm::vec3(2.0f * std::sqrt(kPiF));
  return light;
}

class ModelTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    auto renderer = Renderer::Create();
    ASSERT_TRUE(renderer.ok()) << renderer.message();
    renderer_ = std::move(renderer).value();
  }

  // The square fills a picture of 80 pixels.
  RenderScene Scene() const {
    RenderScene scene;
    scene.display = {80, 80, 120.0, 120.0, 39.5, 39.5};
    scene.camera_from_stage =
        LookAt(Eigen::Vector3d(0, 0, 3), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitY());
    scene.light = EvenLight();
    scene.knee = 1.0f;
    return scene;
  }

  cv::Mat Draw(const RenderScene& scene) {
    const RenderTarget target = MakeTarget(scene.display.width, scene.display.height);
    const Status drawn = renderer_->Draw(scene, target);
    EXPECT_TRUE(drawn.ok()) << drawn.message();
    return Read(target);
  }

  cv::Mat DrawHuman(const human::Human& human, RenderScene scene) {
    auto handle = renderer_->AddHuman(Shared(human));
    EXPECT_TRUE(handle.ok()) << handle.message();
    const std::vector<glm::mat4> skin(human.skeleton.size(), kNoMotion);
    const SceneHuman shown = {.human = *handle, .skin = skin};
    scene.humans = {&shown, 1};
    return Draw(scene);
  }

  std::unique_ptr<Renderer> renderer_;
};

TEST_F(ModelTest, ATextureLiesTheRightWayUpAndKeepsItsColours) {
  cv::Mat image(2, 2, CV_8UC3);
  image.at<cv::Vec3b>(0, 0) = {10, 20, 200};
  image.at<cv::Vec3b>(0, 1) = {10, 200, 20};
  image.at<cv::Vec3b>(1, 0) = {200, 20, 10};
  image.at<cv::Vec3b>(1, 1) = {128, 128, 128};
  cv::Mat large;
  cv::repeat(cv::Mat(1, 1, CV_8UC3), 64, 64, large);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      large.at<cv::Vec3b>(y, x) = image.at<cv::Vec3b>(y / 32, x / 32);
    }
  }
  const cv::Mat picture = DrawHuman(Textured(large, {.name = "", .colour_texture = 0}), Scene());
  for (const auto& [x, y] : {std::pair{20, 20}, {60, 20}, {20, 60}, {60, 60}}) {
    const cv::Vec3b expected = image.at<cv::Vec3b>(y / 40, x / 40);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(picture.at<cv::Vec3b>(y, x)[c], expected[c], 1.0) << x << ", " << y;
    }
  }
}

TEST_F(ModelTest, CoverageMixesInLinearLightWithWhatIsBehind) {
  for (const int alpha : {255, 128, 64}) {
    const cv::Mat white(16, 16, CV_8UC4, cv::Scalar(255, 255, 255, alpha));
    RenderScene scene = Scene();
    scene.background = cv::Mat(80, 80, CV_8UC3, cv::Scalar::all(0));
    scene.camera = scene.display;
    const human::Human human =
        Textured(white, {.name = "", .colour_texture = 0, .alpha_cutoff = 0.1f, .two_sided = true});
    const double linear = alpha / 255.0;
    const double expected = 255.0 * SrgbFromLinear(linear);
    EXPECT_NEAR(DrawHuman(human, scene).at<cv::Vec3b>(40, 40)[0], expected, 2.0) << alpha;
  }
}

TEST_F(ModelTest, AMarkGivesItsColourAndKeepsLightAndShade) {
  human::Human human = MakeHuman(Square(), 1);
  auto handle = renderer_->AddHuman(Shared(human));
  ASSERT_TRUE(handle.ok()) << handle.message();
  const std::vector<glm::mat4> skin(1, kNoMotion);
  SceneHuman shown = {.human = *handle, .skin = skin};
  RenderScene scene = Scene();
  scene.humans = {&shown, 1};
  const auto mean = [&](float exposure) {
    scene.exposure = exposure;
    return cv::mean(Draw(scene));
  };
  const cv::Scalar plain = mean(0.5f);
  EXPECT_NEAR(plain[0], plain[2], 1.0);
  shown.mark = {.colour = {0.0f, 0.2f, 0.8f}, .share = 1.0f};
  const cv::Scalar lit = mean(0.5f);
  const cv::Scalar dark = mean(0.05f);
  EXPECT_LT(lit[2], 3.0) << "no red is left";
  EXPECT_GT(lit[0], lit[1] + 40.0) << "blue above green";
  EXPECT_GT(lit[0], dark[0] + 40.0) << "what is darker stays darker";
  EXPECT_GT(dark[0], 60.0) << "and is seen";
  shown.mark.share = 0.0f;
  EXPECT_EQ(mean(0.5f), plain);
}

TEST_F(ModelTest, StripesTellMarksApartWithoutColours) {
  auto handle = renderer_->AddHuman(Shared(MakeHuman(Square(), 1)));
  ASSERT_TRUE(handle.ok()) << handle.message();
  const std::vector<glm::mat4> skin(1, kNoMotion);
  SceneHuman shown = {.human = *handle, .skin = skin};
  RenderScene scene = Scene();
  scene.exposure = 0.5f;
  scene.humans = {&shown, 1};
  std::array<double, 3> bright = {};
  for (int stripes = 0; stripes < 3; ++stripes) {
    shown.mark = {{0.05f, 0.05f, 0.05f}, 1.0f, stripes, 12.0f};
    cv::Mat grey;
    cv::extractChannel(Draw(scene), grey, 1);
    double least = 0.0;
    double most = 0.0;
    cv::minMaxLoc(grey, &least, &most);
    bright[static_cast<size_t>(stripes)] = cv::countNonZero(grey > 0.5 * (least + most) + 1.0);
  }
  const double all = 80.0 * 80.0;
  EXPECT_EQ(bright[0], 0.0);
  EXPECT_NEAR(bright[1] / all, 1.0 / 3.0, 0.05);
  EXPECT_NEAR(bright[2] / all, 1.0 - 4.0 / 9.0, 0.06);
}

TEST_F(ModelTest, WhatIsLessCoveredThanTheCutoffIsNotThere) {
  const cv::Mat faint(16, 16, CV_8UC4, cv::Scalar(255, 255, 255, 90));
  RenderScene scene = Scene();
  scene.background = cv::Mat(80, 80, CV_8UC3, cv::Scalar(10, 20, 30));
  scene.camera = scene.display;
  const human::Human human =
      Textured(faint, {.name = "", .colour_texture = 0, .alpha_cutoff = 0.5f, .two_sided = true});
  EXPECT_EQ(DrawHuman(human, scene).at<cv::Vec3b>(40, 40), cv::Vec3b(10, 20, 30));
}

TEST_F(ModelTest, TheRimOfHairIsSoft) {
  // Coverage falls from one to nothing across a band of the texture.
  cv::Mat image(64, 64, CV_8UC4);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int alpha = std::clamp(8 * (40 - x), 0, 255);
      image.at<cv::Vec4b>(y, x) = {255, 255, 255, static_cast<uint8_t>(alpha)};
    }
  }
  RenderScene scene = Scene();
  const cv::Mat picture = DrawHuman(Textured(image, {.name = "",
                                                     .surface = human::Surface::kHair,
                                                     .colour_texture = 0,
                                                     .alpha_cutoff = 0.05f,
                                                     .two_sided = true}),
                                    scene);
  std::set<int> greys;
  // The texture repeats at its ends, so these columns are skipped.
  for (int x = 4; x < 76; ++x) {
    EXPECT_LE(picture.at<cv::Vec3b>(40, x)[1], picture.at<cv::Vec3b>(40, x - 1)[1] + 1) << x;
    greys.insert(picture.at<cv::Vec3b>(40, x)[1]);
  }
  EXPECT_GT(greys.size(), 15u);
}

TEST_F(ModelTest, HairHidesWhatIsBehindItWhereItIsDense) {
  const cv::Mat dense(16, 16, CV_8UC4, cv::Scalar(0, 0, 255, 255));
  human::Human human = Textured(
      dense,
      {.name = "", .surface = human::Surface::kPlain, .colour_texture = 0, .alpha_cutoff = 0.3f});
  human.meshes.push_back(Square());  // behind it, drawn first
  human.meshes[1].name = "behind";
  for (glm::vec3& position : human.meshes[1].positions) {
    position.z = -0.5f;
  }
  const cv::Vec3b pixel = DrawHuman(human, Scene()).at<cv::Vec3b>(40, 40);
  EXPECT_EQ(pixel, cv::Vec3b(0, 0, 255));
}

TEST_F(ModelTest, ANormalMapTurnsTheSurface) {
  // Light from +X, +Y and behind the viewer; the map tilts by 45 degrees.
  const auto brightness = [&](double x, double y) {
    const double z = std::sqrt(1.0 - x * x - y * y);
    const cv::Mat map(8, 8, CV_8UC3,
                      cv::Scalar(127.5 + 127.5 * z, 127.5 + 127.5 * y, 127.5 + 127.5 * x));
    human::Human human = Textured(map, {.name = "", .normal_texture = 0});
    RenderScene scene = Scene();
    scene.light[3] = glm::vec3(0.4f);  // brighter towards +X
    scene.light[1] = glm::vec3(0.2f);  // brighter towards +Y
    scene.exposure = 0.4f;
    return static_cast<int>(DrawHuman(human, scene).at<cv::Vec3b>(40, 40)[1]);
  };
  const auto expected = [&](const glm::vec3& normal) {
    light::ShRgb light = EvenLight();
    light[3] = glm::vec3(0.4f);
    light[1] = glm::vec3(0.2f);
    const float linear = 0.4f * light::EvaluateIrradiance(light, normal).x / kPiF;
    return 255.0 * SrgbFromLinear(linear);
  };
  const float s = std::sqrt(0.5f);
  EXPECT_NEAR(brightness(0, 0), expected({0, 0, 1}), 2.0);
  EXPECT_NEAR(brightness(s, 0), expected({s, 0, s}), 2.0);
  EXPECT_NEAR(brightness(-s, 0), expected({-s, 0, s}), 2.0);
  EXPECT_NEAR(brightness(0, s), expected({0, s, s}), 2.0);
}

// The metal is smooth, because the model loses light that is reflected several times in rough
// metal.
TEST_F(ModelTest, EverySurfaceIsLitWithinReason) {
  const cv::Mat grey(8, 8, CV_8UC3, cv::Scalar::all(120));
  for (const human::Surface surface :
       {human::Surface::kPlain, human::Surface::kSkin, human::Surface::kHair,
        human::Surface::kCloth, human::Surface::kEye, human::Surface::kMetal}) {
    RenderScene scene = Scene();
    const cv::Mat picture =
        DrawHuman(Textured(grey, {.name = "",
                                  .surface = surface,
                                  .colour_texture = 0,
                                  .roughness = surface == human::Surface::kMetal ? 0.2f : 0.8f}),
                  scene);
    EXPECT_GT(picture.at<cv::Vec3b>(40, 40)[1], 95) << static_cast<int>(surface);
    EXPECT_LT(picture.at<cv::Vec3b>(40, 40)[1], 150) << static_cast<int>(surface);
  }
}

// Highlights of eyes are sharper than the distance of vertices, so the maximum is large. Hair is
// not tested, because lighting at vertices assumes that strands hang down.
TEST_F(ModelTest, LightAtVerticesIsThatAtPixelsWhereVerticesAreClose) {
  for (const human::Surface surface :
       {human::Surface::kPlain, human::Surface::kSkin, human::Surface::kCloth, human::Surface::kEye,
        human::Surface::kMetal}) {
    human::Human human = MakeHuman(Sphere(glm::vec3(0.5f)), 1);
    human.materials = {{.name = "", .surface = surface, .colour = glm::vec3(0.9f, 0.7f, 0.5f)}};
    human.meshes[0].material = 0;
    RenderScene scene = Scene();
    scene.light[3] = glm::vec3(0.8f);
    scene.sun = light::Sun{glm::normalize(glm::vec3(1.0f, 1.0f, 0.5f)), glm::vec3(2.0f), 0.005f};
    const light::Lamp lamp = {.position = {-2.0f, 0.5f, 2.0f}, .intensity = glm::vec3(1.5f)};
    scene.lamps = {&lamp, 1};
    renderer_->SetQuality({.reflections = false});
    const cv::Mat at_pixels = DrawHuman(human, scene);
    renderer_->SetQuality({.pixel_light = false});
    EXPECT_TRUE(test::ImagesAgree(DrawHuman(human, scene), at_pixels, {.max = 60.0, .mean = 0.6}))
        << static_cast<int>(surface);
  }
}

TEST_F(ModelTest, BothSidesOfASheetAreLitAtVerticesToo) {
  for (const float side : {1.0f, -1.0f}) {
    RenderScene scene = Scene();
    scene.camera_from_stage = LookAt(Eigen::Vector3d(0, 0, 3.0 * side), Eigen::Vector3d::Zero(),
                                     Eigen::Vector3d::UnitY());
    scene.sun = light::Sun{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(1.0f), 0.005f};
    const human::Human sheet = Textured(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(90)),
                                        {.name = "", .colour_texture = 0, .two_sided = true});
    const cv::Mat at_pixels = DrawHuman(sheet, scene);
    renderer_->SetQuality({.pixel_light = false});
    EXPECT_TRUE(test::ImagesAgree(DrawHuman(sheet, scene), at_pixels, {.max = 2.0, .mean = 0.5}))
        << side;
    renderer_->SetQuality({});
  }
}

TEST_F(ModelTest, EyesGlintTowardsTheLampAndMatteThingsDoNot) {
  const auto brightest = [&](human::Surface surface) {
    human::Human human = MakeHuman(Sphere(glm::vec3(0.2f)), 1);
    human.materials = {{.name = "", .surface = surface}};
    human.meshes[0].material = 0;
    RenderScene scene = Scene();
    scene.display = {160, 160, 240.0, 240.0, 79.5, 79.5};
    scene.light = {};
    const auto basis = light::EvaluateShBasis(glm::normalize(glm::vec3(0.5f, 0.5f, 1.0f)));
    for (int i = 0; i < light::kShCount; ++i) {
      scene.light[i] = glm::vec3(2.0f * basis[i]);
    }
    double most = 0.0;
    cv::minMaxLoc(DrawHuman(human, scene).reshape(1), nullptr, &most);
    return most;
  };
  EXPECT_GT(brightest(human::Surface::kEye), brightest(human::Surface::kPlain) + 30.0);
}

// Tests folds in a coarse level of detail, where the backs of triangles are visible but their
// normals point to the eye.
TEST_F(ModelTest, ClothThatFoldsOverIsLitAsItsFront) {
  const auto brightness = [&](human::Surface surface, float normal) {
    human::Human human = MakeHuman(Square(), 1);
    human.meshes[0].indices = {0, 2, 1, 0, 3, 2};
    human.meshes[0].normals.assign(4, glm::vec3(0.0f, 0.0f, normal));
    human.meshes[0].material = 0;
    human.materials = {{.name = "", .surface = surface, .two_sided = true}};
    human.light.meshes.resize(1);
    human.light.meshes[0].backs.assign(4, {0, 0, 0});
    const std::vector<glm::vec3> irradiance(4, glm::vec3(std::numbers::pi_v<float>));
    const SceneHuman shown = {.human = renderer_->AddHuman(Shared(human)).value(),
                              .skin = {&kNoMotion, 1},
                              .irradiance = irradiance};
    RenderScene scene = Scene();
    scene.humans = {&shown, 1};
    return Draw(scene).at<cv::Vec3b>(40, 40)[1];
  };
  EXPECT_GT(brightness(human::Surface::kCloth, 1.0f), 200);
  EXPECT_LT(brightness(human::Surface::kCloth, -1.0f), 40) << "its back, dark within";
  EXPECT_LT(brightness(human::Surface::kPlain, 1.0f), 40);
}

// The texture has columns of one texel, so that at half the resolution it is grey everywhere.
TEST_F(ModelTest, TexturesBecomeFinerBesideDrawingAndNeverCoarser) {
  cv::Mat columns(256, 256, CV_8UC3, cv::Scalar::all(0));
  for (int x = 0; x < columns.cols; x += 2) {
    columns.col(x).setTo(cv::Scalar::all(255));
  }
  const human::Human human = Textured(columns, {.name = "", .colour_texture = 0});
  const std::vector<glm::mat4> skin(human.skeleton.size(), kNoMotion);
  RenderScene scene = Scene();
  scene.display = {600, 600, 900.0, 900.0, 299.5, 299.5};  // a texel covers more than two pixels
  SceneHuman shown = {.human = renderer_->AddHuman(Shared(human)).value(), .skin = skin};
  scene.humans = {&shown, 1};
  const cv::Mat fine = Draw(scene);

  renderer_ = Renderer::Create({.texture_halvings = 1}).value();
  shown.human = renderer_->AddHuman(Shared(human)).value();
  const SceneHuman other = {.human = renderer_->AddHuman(Shared(human)).value(), .skin = skin};
  const cv::Mat coarse = Draw(scene);
  double least = 0.0;
  double most = 0.0;
  cv::minMaxLoc(coarse(cv::Rect(200, 200, 200, 200)).clone().reshape(1), &least, &most);
  EXPECT_LT(most - least, 5.0);

  renderer_->SetQuality({});
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  cv::Mat picture = Draw(scene);
  while (cv::norm(picture, fine, cv::NORM_INF) > 0.0 &&
         std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    picture = Draw(scene);
  }
  EXPECT_EQ(cv::norm(picture, fine, cv::NORM_INF), 0.0);
  scene.humans = {&other, 1};
  EXPECT_EQ(cv::norm(Draw(scene), fine, cv::NORM_INF), 0.0) << "they share it";
  renderer_->SetQuality({.texture_halvings = 1});
  EXPECT_EQ(cv::norm(Draw(scene), fine, cv::NORM_INF), 0.0);
}

TEST_F(ModelTest, WhoLeavesWhileTexturesBecomeFinerLeavesNothingBehind) {
  renderer_ = Renderer::Create({.texture_halvings = 2}).value();
  const human::Human human = Textured(cv::Mat(1024, 1024, CV_8UC3, cv::Scalar::all(90)),
                                      {.name = "", .colour_texture = 0});
  const ModelHandle handle = renderer_->AddHuman(Shared(human)).value();
  renderer_->SetQuality({});
  Draw(Scene());  // starts decoding
  renderer_->RemoveModel(handle);
  for (int i = 0; i < 50; ++i) {
    Draw(Scene());
  }
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(ModelTest, ABrokenTextureIsOneClearError) {
  human::Human human =
      Textured(cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(9)), {.name = "", .colour_texture = 0});
  human::Texture broken = *human.textures[0];
  broken.encoded.resize(40);
  human.textures[0] = std::make_shared<const human::Texture>(std::move(broken));
  EXPECT_THAT(renderer_->AddHuman(Shared(human)).message(), HasSubstr("test: texture 'texture'"));
}

TEST_F(ModelTest, StreamedVerticesReplaceThoseOfTheBindPose) {
  human::Human human = MakeHuman(Square(), 1);
  human.morphs = {{"left",
                   {{0,
                     {0, 1, 2, 3},
                     std::vector<glm::vec3>(4, glm::vec3(-1, 0, 0)),
                     std::vector<glm::vec3>(4, glm::vec3(0.0f))}}}};
  const ModelHandle handle = renderer_->AddHuman(Shared(human)).value();
  glm::mat4 right(1.0f);
  right[3].x = 1.0f;
  std::vector<glm::vec3> moved = human.meshes[0].positions;
  for (glm::vec3& position : moved) {
    position.x -= 1.0f;
  }
  SceneVertices vertices = {.mesh = 0, .positions = moved, .normals = human.meshes[0].normals};
  SceneHuman shown = {.human = handle, .skin = {&right, 1}, .vertices = {&vertices, 1}};
  RenderScene scene = Scene();
  scene.humans = {&shown, 1};
  // The morph moves the square one metre to the left, the skin one metre to the right.
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 40), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 5), cv::Vec3b(255, 255, 255));
  // Posed vertices are moved to the left only.
  vertices.posed = true;
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 5), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 60), cv::Vec3b(0, 0, 0));
  // Without vertices, the skin moves the square to the right only.
  shown.vertices = {};
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 5), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(40, 60), cv::Vec3b(255, 255, 255));

  vertices.positions = vertices.positions.first(2);
  shown.vertices = {&vertices, 1};
  EXPECT_THAT(renderer_->Draw(scene, MakeTarget(8, 8)).message(), HasSubstr("moving vertices"));
}

TEST_F(ModelTest, TwoOfOnePersonEachHaveTheirOwnVertices) {
  const human::Human human = MakeHuman(Square(), 1);
  const ModelHandle handle = renderer_->AddHuman(Shared(human)).value();
  std::array<std::vector<glm::vec3>, 2> moved = {human.meshes[0].positions,
                                                 human.meshes[0].positions};
  std::array<SceneVertices, 2> vertices;
  std::array<SceneHuman, 2> shown;
  for (size_t i = 0; i < 2; ++i) {
    for (glm::vec3& position : moved[i]) {
      position.x = 0.3f * position.x + (i == 0 ? -0.6f : 0.6f);
    }
    vertices[i] = {.mesh = 0, .positions = moved[i], .normals = human.meshes[0].normals};
    shown[i] = {.human = handle, .skin = {&kNoMotion, 1}, .vertices = {&vertices[i], 1}};
  }
  RenderScene scene = Scene();
  scene.humans = shown;
  const cv::Mat picture = Draw(scene);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 16), cv::Vec3b(255, 255, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 40), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 64), cv::Vec3b(255, 255, 255));
  // The same memory holds other vertices in the next picture.
  for (std::vector<glm::vec3>& positions : moved) {
    for (glm::vec3& position : positions) {
      position.x -= position.x < 0.0f ? -0.6f : 0.6f;
    }
  }
  const cv::Mat next = Draw(scene);
  EXPECT_EQ(next.at<cv::Vec3b>(40, 16), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(next.at<cv::Vec3b>(40, 40), cv::Vec3b(255, 255, 255));
}

TEST_F(ModelTest, DualQuaternionsSkinAsTheCpuDoes) {
  human::Human bent = MakeHuman(BendingBox(glm::vec3(0.7f, 0.5f, 0.3f)), 3);
  bent.skinning = human::Skinning::kDualQuaternion;
  glm::mat4 twisted = glm::rotate(glm::mat4(1.0f), 2.4f, glm::vec3(0.1f, 1.0f, 0.2f));
  twisted[3] = glm::vec4(0.2f, 0.1f, -0.1f, 1.0f);
  glm::mat4 scaled = glm::rotate(glm::mat4(1.0f), -1.0f, glm::vec3(0.0f, 1.0f, 0.0f));
  scaled = glm::scale(scaled, glm::vec3(1.2f));
  const std::array skin = {glm::mat4(1.0f), twisted, scaled};
  human::Human still = bent;
  human::SkinMesh(bent.meshes[0], skin, still.meshes[0].positions, still.meshes[0].normals,
                  human::Skinning::kDualQuaternion);
  const std::array rest = {kNoMotion, kNoMotion, kNoMotion};

  RenderScene scene = Scene();
  scene.display = {200, 200, 180.0, 180.0, 99.5, 99.5};
  scene.camera_from_stage = LookAt(Eigen::Vector3d(1.0, 1.4, 3.5), Eigen::Vector3d(0.0, 1.0, 0.0),
                                   Eigen::Vector3d::UnitY());
  scene.exposure = 0.5f;
  scene.light[3] = glm::vec3(0.3f, 0.6f, 0.9f);
  SceneHuman human = {.human = renderer_->AddHuman(Shared(bent)).value(), .skin = skin};
  scene.humans = {&human, 1};
  const cv::Mat on_gpu = Draw(scene);
  human = {.human = renderer_->AddHuman(Shared(still)).value(), .skin = rest};
  const cv::Mat on_cpu = Draw(scene);
  EXPECT_GT(cv::countNonZero(on_cpu.reshape(1)), 3000);
  cv::Mat difference;
  cv::absdiff(on_gpu, on_cpu, difference);
  // Pixels at edges may differ, pixels of surfaces may not.
  EXPECT_LT(cv::countNonZero(difference.reshape(1) > 3), 12);
}

stage::Prop TwoPartProp() {
  stage::Prop prop;
  prop.name = "chest";
  prop.parts.resize(2);
  for (size_t i = 0; i < 2; ++i) {
    const human::SkinnedMesh square = Square();
    stage::PropMesh mesh;
    mesh.positions = square.positions;
    for (glm::vec3& position : mesh.positions) {
      position *= 0.3f;
    }
    mesh.normals = square.normals;
    mesh.albedo.assign(4, i == 0 ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 0));
    mesh.indices = square.indices;
    mesh.emission = i == 0 ? glm::vec3(0.0f) : glm::vec3(0, 1, 0);
    prop.parts[i].name = i == 0 ? "box" : "flame";
    prop.parts[i].meshes = {mesh};
  }
  return prop;
}

TEST_F(ModelTest, PartsOfAPropMoveShineAndHideByThemselves) {
  const stage::Prop prop = TwoPartProp();
  ASSERT_TRUE(prop.Validate("test").ok());
  std::array parts = {kNoMotion, kNoMotion};
  parts[0][3].x = -0.6f;
  parts[1][3].x = 0.6f;
  SceneProp shown = {.prop = renderer_->AddProp(Shared(prop)).value(), .stage_from_part = parts};
  RenderScene scene = Scene();
  scene.props = {&shown, 1};
  cv::Mat picture = Draw(scene);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 16), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 40), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 64), cv::Vec3b(0, 255, 0));  // unlit, it shines
  const std::array<uint8_t, 2> only_box = {1, 0};
  shown.shown = only_box;
  picture = Draw(scene);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 16), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 64), cv::Vec3b(0, 0, 0));
}

TEST_F(ModelTest, OccludersHidePropsToo) {
  const stage::Prop prop = TwoPartProp();
  const std::array parts = {kNoMotion, kNoMotion};
  const std::array<uint8_t, 2> only_box = {1, 0};
  const SceneProp shown = {.prop = renderer_->AddProp(Shared(prop)).value(),
                           .stage_from_part = parts,
                           .shown = only_box};
  const MeshHandle wall =
      renderer_->AddMesh({.positions = {{0, -2, 1}, {2, -2, 1}, {2, 2, 1}, {0, 2, 1}},
                          .normals = {},
                          .indices = {0, 1, 2, 0, 2, 3}});
  const SceneOccluder occluder = {.mesh = wall};
  RenderScene scene = Scene();
  scene.props = {&shown, 1};
  scene.occluders = {&occluder, 1};
  const cv::Mat picture = Draw(scene);
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 34), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(picture.at<cv::Vec3b>(40, 46), cv::Vec3b(0, 0, 0));
}

TEST_F(ModelTest, DrawsTheCoarsestAllowedLevel) {
  human::Human human = MakeHuman(Square(), 1);
  human.meshes[0].coarser = {{0.01f, {0, 1, 2}}};  // the lower right half
  SceneHuman shown = {.human = renderer_->AddHuman(Shared(human)).value(), .skin = {&kNoMotion, 1}};
  RenderScene scene = Scene();
  scene.humans = {&shown, 1};
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(10, 10), cv::Vec3b(255, 255, 255));
  const float share = human::ErrorShare(human::Surface::kPlain);
  shown.detail = 0.009f * share;
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(10, 10), cv::Vec3b(255, 255, 255));
  shown.detail = 0.011f * share;
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(10, 10), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(Draw(scene).at<cv::Vec3b>(70, 70), cv::Vec3b(255, 255, 255));
}

glm::dvec3 LinearAt(const cv::Mat& picture, int x, int y) {
  const cv::Vec3b pixel = picture.at<cv::Vec3b>(y, x);
  glm::dvec3 linear;
  for (int channel = 0; channel < 3; ++channel) {
    linear[channel] = LinearFromSrgb(pixel[2 - channel] / 255.0);
  }
  return linear;
}

TEST_F(ModelTest, ALampLightsWhatHasNoTransferByTheCosineLaw) {
  RenderScene scene = Scene();
  scene.light = {};
  const light::Lamp lamp = {{0.0f, 0.0f, 1.0f}, glm::vec3(1.0f, 0.8f, 0.5f), 0.05f};
  scene.lamps = {&lamp, 1};
  scene.display = {80, 80, 240.0, 240.0, 39.5, 39.5};
  const cv::Mat picture = DrawHuman(MakeHuman(Square(), 1), scene);
  const glm::dvec3 expected = glm::dvec3(lamp.intensity) / std::numbers::pi;
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(LinearAt(picture, 40, 40)[channel], expected[channel], 0.006) << channel;
  }
}

std::vector<uint32_t> EvenReflections(const glm::vec3& radiance) {
  return std::vector<uint32_t>(light::GlossyMap::kTexels, light::PackRadiance(radiance));
}

human::Human RoughSquare(human::Surface surface, const glm::vec3& albedo) {
  human::SkinnedMesh square = Square();
  square.albedo.assign(4, albedo);
  human::Human human = MakeHuman(square, 1);
  human.materials = {{.name = "", .surface = surface, .roughness = 0.4f}};
  human.meshes[0].material = 0;
  return human;
}

TEST_F(ModelTest, EvenReflectionsAreTheShareOfEvenLight) {
  // Viewed along the normal, a dielectric with f0 0.028 and roughness 0.4 reflects 2.44 % of
  // uniform light. A black surface shows nothing else.
  const human::Human human = RoughSquare(human::Surface::kSkin, glm::vec3(0.0f));
  SceneHuman shown;
  shown.human = renderer_->AddHuman(Shared(human)).value();
  shown.skin = {&kNoMotion, 1};
  light::ProbeLight light;
  shown.light = &light;
  RenderScene scene = Scene();
  scene.light = {};
  scene.humans = {&shown, 1};
  const std::vector<uint32_t> reflections = EvenReflections(glm::vec3(4.0f));
  scene.glossy = reflections;
  scene.glossy_number = 1;
  EXPECT_LT(LinearAt(Draw(scene), 40, 40).r, 0.002);
  scene.light = light.sky = EvenLight();
  const double mirrored = LinearAt(Draw(scene), 40, 40).r;
  EXPECT_NEAR(mirrored, 4.0 * 0.0244, 0.01);
  // With half of the light, the reflection is half as bright.
  for (glm::vec3& c : light.sky) {
    c *= 0.5f;
  }
  EXPECT_NEAR(LinearAt(Draw(scene), 40, 40).r, 0.5 * mirrored, 0.005);
}

// Viewed along the normal, a perfect reflector with roughness 0.4 returns 0.78 of uniform light
// (multiple reflections are ignored).
TEST_F(ModelTest, MetalsMirrorInTheirOwnColourAndAreNotMatte) {
  const glm::vec3 bronze(0.8f, 0.5f, 0.2f);
  RenderScene scene = Scene();
  scene.light = EvenLight();
  const std::vector<uint32_t> reflections = EvenReflections(glm::vec3(0.8f));
  scene.glossy = reflections;
  scene.glossy_number = 1;
  const cv::Mat picture = DrawHuman(RoughSquare(human::Surface::kMetal, bronze), scene);
  const glm::dvec3 seen = LinearAt(picture, 40, 40);
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(seen[channel], 0.8 * 0.78 * bronze[channel], 0.02) << channel;
  }
}

}  // namespace
}  // namespace lararium::render
