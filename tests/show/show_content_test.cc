#include "shared/show/show_content.h"

#include <gmock/gmock.h>

#include <map>
#include <utility>

#include "shared/bundle/bundle_writer.h"
#include "shared/core/file.h"
#include "shared/core/log.h"
#include "shared/show/show.h"
#include "shared/stage/mesh_file.h"
#include "tests/human/rich_human.h"
#include "tests/stage/test_props.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::show {
namespace {

using ::testing::HasSubstr;

class ShowContentTest : public ::testing::Test {
 protected:
  void SetUp() override {
    geometry::TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    wall_ = stage::SerializeMesh(mesh);
    manifest_.title = "Two rooms";
    manifest_.drama = "drama.lua";
    manifest_.places.resize(2);
    manifest_.places[0].name = "bar";
    manifest_.places[0].scene = "bar.larscene";
    manifest_.places[1].name = "yard";
    manifest_.places[1].scene = "yard.larscene";
    manifest_.places[0].map_from_stage.scale = 2.0;
    manifest_.places[1].camera_nudge = {0.0, 0.1, 0.0};
    manifest_.places[1].camera = light::CameraTraits{640, 0.01f};
    manifest_.places[1].probes.emplace_back().light.sky[0] = {1.0f, 2.0f, 3.0f};
    manifest_.places[1].occluders = {{"wall", "wall.larmesh", {}}};
  }

  Result<ShowContent> Load(std::string_view place = {}, float finest = 0.0f) {
    const std::string drama = "function main() end\n";
    const std::filesystem::path path = folder_ / "a.larshow";
    const Status written = bundle::WriteBundle(path, manifest_,
                                               {{"drama.lua", std::as_bytes(std::span(drama))},
                                                {"bar.larscene", bar_},
                                                {"yard.larscene", yard_},
                                                {"wall.larmesh", wall_},
                                                {"cup.larprop", cup_},
                                                {"keeper.larhuman", human_},
                                                {"hello.json", std::as_bytes(std::span(hello_))},
                                                {"book.json", std::as_bytes(std::span(book_))}});
    LARARIUM_RETURN_IF_ERROR(written);
    LARARIUM_ASSIGN_OR_RETURN(const bundle::Bundle bundle, bundle::Bundle::Open(path));
    return LoadShowContent(bundle, place, {}, finest);
  }

  test::TemporaryFolder folder_;
  bundle::ShowManifest manifest_;
  std::vector<std::byte> bar_ = test::OnePointScene(50.0);
  std::vector<std::byte> yard_ = test::OnePointScene(60.0);
  std::vector<std::byte> wall_;
  std::vector<std::byte> cup_ = stage::SerializeProp(test::MakeCup());
  std::vector<std::byte> human_ = human::SerializeHuman(human::RichHuman());
  std::string hello_ = R"({"schema": 1, "duration": 0.5, "visemes": [{"t": 0, "viseme": "aa"}]})";
  std::string book_ =
      R"({"schema": 1, "names": {"keeper": {"en": "Keeper", "it": "Oste"}}, "lines": {
      "hello": {"en": [{"begin": 0, "end": 1, "text": "Welcome"}],
                "it": [{"begin": 0, "end": 1, "text": "Benvenuti"}]}}})";
};

TEST_F(ShowContentTest, ObjectsOfOneMemberShareTheirModel) {
  geometry::Rigid3 there;
  there.translation = {0.0, 0.8, -1.0};
  manifest_.objects = {{"cup", "cup.larprop", {}}, {"other_cup", "cup.larprop", there}};
  manifest_.lines = {{"hello", "", {{"la", {"hello.json", ""}}}}};
  manifest_.spoken = {{"la", ""}};
  const auto content = Load();
  ASSERT_TRUE(content.ok()) << content.message();
  ASSERT_EQ(content->objects.size(), 2u);
  EXPECT_EQ(content->objects[0].model, content->objects[1].model);
  EXPECT_EQ(content->objects[0].model->prop().parts.size(), 2u);
  EXPECT_EQ(content->objects[1].stage_from_object.position, glm::vec3(0.0f, 0.8f, -1.0f));
  ASSERT_EQ(content->speech.size(), 1u);
  EXPECT_EQ(content->speech[0].visemes.keys.size(), 1u);

  cup_.resize(cup_.size() / 2);
  EXPECT_THAT(Load().message(), HasSubstr("cup.larprop"));
}

TEST_F(ShowContentTest, ThePeopleOfAClosedBundleAreReadInMoreDetail) {
  human::Human human = human::RichHuman();
  human.meshes[0].coarser = {{0.01f, {0, 1, 2}}};
  human_ = human::SerializeHuman(human);
  manifest_.cast = {{"keeper", "keeper.larhuman"}};
  const auto whole = Load();
  ASSERT_TRUE(whole.ok()) << whole.message();
  EXPECT_EQ(whole->cast[0].human->meshes[0].positions.size(), 4u);
  EXPECT_FALSE(whole->finer);

  const auto content = Load({}, 1.0f);
  ASSERT_TRUE(content.ok()) << content.message();
  EXPECT_EQ(content->cast[0].human->meshes[0].positions.size(), 3u);
  EXPECT_EQ(content->cast[0].finest, 1.0f);
  ASSERT_TRUE(content->finer);
  const auto finer = content->finer(0, 0.001f);
  ASSERT_TRUE(finer.ok()) << finer.message();
  EXPECT_EQ(finer->human->meshes[0].positions, human.meshes[0].positions);
  EXPECT_EQ(finer->light->at(0).vertices(), 4u);
  // The same objects in memory.
  EXPECT_EQ(finer->human->textures, content->cast[0].human->textures);

  // The file has changed since it was opened.
  human.meshes[0].positions[0].y += 1.0f;
  human_ = human::SerializeHuman(human);
  ASSERT_TRUE(Load().ok());
  EXPECT_THAT(content->finer(0, 0.001f).message(), HasSubstr("keeper.larhuman"));
}

TEST_F(ShowContentTest, BrokenSpeechIsNamed) {
  manifest_.lines = {{"hello", "", {{"la", {"hello.json", ""}}}}};
  manifest_.spoken = {{"la", ""}};
  hello_ = "{}";
  EXPECT_THAT(Load().message(), HasSubstr("hello.json"));
}

TEST_F(ShowContentTest, LoadsAllPlacesInTheBundlesOrder) {
  const auto content = Load();
  ASSERT_TRUE(content.ok()) << content.message();
  ASSERT_EQ(content->places.size(), 2u);
  const ShowPlace& bar = content->places[0];
  const ShowPlace& yard = content->places[1];
  EXPECT_EQ(bar.stage.name, "bar");
  EXPECT_EQ(bar.stage.map_from_stage.scale, 2.0);
  EXPECT_EQ(bar.map->camera.fx, 50.0);
  EXPECT_TRUE(bar.stage.occluders.empty());
  EXPECT_EQ(yard.stage.name, "yard");
  EXPECT_EQ(yard.stage.camera_nudge.y(), 0.1);
  EXPECT_EQ(yard.stage.camera, (light::CameraTraits{640, 0.01f}));
  EXPECT_EQ(yard.stage.probes.at(0).light.sky[0], glm::vec3(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(yard.map->camera.fx, 60.0);
  EXPECT_EQ(yard.stage.occluders.size(), 1u);
  EXPECT_EQ(Maps(content->places)[1], yard.map);
}

TEST_F(ShowContentTest, OccludersDoWhatTheBundleSays) {
  manifest_.places[1].occluders[0].blocks_walking = false;
  manifest_.places[1].occluders[0].receives_shadow = false;
  // The yard's occluders block walking at the bar too.
  const auto bar = Load("bar");
  ASSERT_TRUE(bar.ok()) << bar.message();
  EXPECT_FALSE(bar->elsewhere.at(0).occluders.at(0).blocks_walking);
  const auto yard = Load("yard");
  ASSERT_TRUE(yard.ok()) << yard.message();
  const stage::Occluder& wall = yard->places[0].stage.occluders[0];
  EXPECT_TRUE(wall.blocks_sound && !wall.blocks_walking && !wall.receives_shadow);
}

TEST_F(ShowContentTest, PutsOccludersWhereTheMapHasThem) {
  manifest_.places[1].map_from_stage.scale = 2.0;
  manifest_.places[1].map_from_stage.translation = {1.0, 0.0, 0.0};
  manifest_.places[1].occluders[0].stage_from_mesh.translation = {0.0, 0.0, 5.0};
  const auto content = Load("yard");
  ASSERT_TRUE(content.ok()) << content.message();
  const auto meshes = OccludersInMap(content->places[0].stage);
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_THAT(meshes[0].indices, ::testing::ElementsAre(0, 1, 2));
  ASSERT_EQ(meshes[0].positions.size(), 3u);
  EXPECT_EQ(meshes[0].positions[0], Eigen::Vector3f(1.0f, 0.0f, 10.0f));
  EXPECT_EQ(meshes[0].positions[1], Eigen::Vector3f(3.0f, 0.0f, 10.0f));
}

TEST_F(ShowContentTest, LoadsOnlyTheNamedPlace) {
  const auto content = Load("yard");
  ASSERT_TRUE(content.ok()) << content.message();
  ASSERT_EQ(content->places.size(), 1u);
  EXPECT_EQ(content->places[0].stage.name, "yard");
  EXPECT_THAT(Load("attic").message(), HasSubstr("has no place \"attic\""));
}

TEST_F(ShowContentTest, OneBrokenPlaceIsAnErrorUnlessItIsNotWanted) {
  yard_.resize(yard_.size() / 2);
  EXPECT_THAT(Load().message(), HasSubstr("yard.larscene"));
  EXPECT_TRUE(Load("bar").ok());
  yard_ = test::OnePointScene(60.0);
  wall_.resize(20);
  EXPECT_THAT(Load().message(), HasSubstr("wall.larmesh"));
}

TEST_F(ShowContentTest, DescriptionsAreInTheLanguageThatIsRead) {
  manifest_.cast = {{"keeper", "keeper.larhuman"}};
  manifest_.lines = {{"d_bar",
                      bundle::LineEntry::kDescription,
                      {{"it", {"hello.json", ""}}, {"en", {"keeper.larhuman", ""}}}},
                     {"hello", "keeper", {{"la", {"hello.json", ""}}}}};
  manifest_.spoken = {{"la", ""}};
  manifest_.captions = {"it", "en"};
  manifest_.descriptions = {{"it", ""}, {"en", ""}};
  const auto content = Load();
  ASSERT_TRUE(content.ok()) << content.message();
  EXPECT_TRUE(content->has_descriptions);
  EXPECT_TRUE(content->speech[0].describes);
  EXPECT_FALSE(content->speech[1].describes);
  EXPECT_EQ(content->speech[0].visemes.keys.size(), 1u) << "not that of another language";
  // A cast member may have that name.
  manifest_.cast[0].name = "description";
  const auto actors = Load();
  ASSERT_TRUE(actors.ok()) << actors.message();
  EXPECT_FALSE(actors->has_descriptions);
}

TEST_F(ShowContentTest, OtherLanguagesShareThePeople) {
  manifest_.cast = {{"keeper", "keeper.larhuman"}};
  manifest_.lines = {{"hello", "keeper", {{"la", {"hello.json", ""}}}}};
  manifest_.spoken = {{"la", "book.json"}};
  manifest_.captions = {"en", "it"};
  const auto english = Load();
  ASSERT_TRUE(english.ok()) << english.message();
  EXPECT_EQ(english->speech[0].captions[0].text, "Welcome");
  const auto bundle = bundle::Bundle::Open(folder_ / "a.larshow");
  ASSERT_TRUE(bundle.ok()) << bundle.message();
  const auto italian = LoadInLanguages(*bundle, {"", "it"}, *english);
  ASSERT_TRUE(italian.ok()) << italian.message();
  ASSERT_EQ(italian->speech.size(), 1u);
  EXPECT_EQ(italian->speech[0].captions[0].text, "Benvenuti");
  EXPECT_EQ(italian->cast[0].title, "Oste");
  EXPECT_EQ(italian->language, "it");
  EXPECT_EQ(italian->cast[0].human, english->cast[0].human) << "read only once";
  const auto silent = LoadInLanguages(*bundle, {"", std::string(kNoCaptions)}, *italian);
  ASSERT_TRUE(silent.ok()) << silent.message();
  EXPECT_TRUE(silent->speech[0].captions.empty());
  EXPECT_EQ(silent->cast[0].title, "");
  EXPECT_EQ(silent->language, "en") << "the guide is in the author's language";
  const auto guided =
      LoadInLanguages(*bundle, {"", std::string(kNoCaptions), false, "it"}, *italian);
  ASSERT_TRUE(guided.ok()) << guided.message();
  EXPECT_TRUE(guided->speech[0].captions.empty());
  EXPECT_EQ(guided->language, "it") << "the visitor reads the guide as the captions before";
  EXPECT_THAT(LoadInLanguages(*bundle, {"", "fr"}, *english).message(), HasSubstr("fr"));
}

// Members arrive one by one, as in a browser.
class ArrivingShowTest : public ShowContentTest {
 protected:
  void SetUp() override {
    ShowContentTest::SetUp();
    manifest_.cast = {{"keeper", "keeper.larhuman"}};
    manifest_.objects = {{"cup", "cup.larprop", {}}};
    manifest_.lines = {{"hello", "keeper", {{"la", {"la.json", ""}}, {"en", {"en.json", ""}}}},
                       {"only_la", "keeper", {{"la", {"only_la.json", ""}}}},
                       {"d",
                        bundle::LineEntry::kDescription,
                        {{"it", {"d_it.json", ""}}, {"en", {"d_en.json", ""}}}}};
    manifest_.spoken = {{"la", ""}, {"en", ""}};
    manifest_.captions = {"it", "en"};
    manifest_.descriptions = {{"it", ""}, {"en", ""}};
    members_ = {{"drama.lua", Bytes("function main() end\n")},
                {"bar.larscene", bar_},
                {"yard.larscene", yard_},
                {"wall.larmesh", wall_},
                {"cup.larprop", cup_},
                {"keeper.larhuman", human_}};
    for (const char* name : {"la.json", "en.json", "only_la.json", "d_it.json", "d_en.json"}) {
      members_.emplace(name, Bytes(hello_));
    }
  }

  static std::span<const std::byte> Bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
  }

  bundle::Bundle Empty() {
    manifest_.members.clear();
    for (const auto& [name, bytes] : members_) {
      manifest_.members.push_back({name, bytes.size(), bundle::ComputeSha256(bytes)});
    }
    const std::string text = bundle::FormatShowManifest(manifest_);
    const bundle::SecretKey key = bundle::MakeSecretKey();
    const bundle::Signature signature = Sign(Bytes(text), key);
    auto opened = bundle::Bundle::FromManifest(text, std::as_bytes(std::span(signature)),
                                               key.public_key(), "show");
    CHECK(opened.ok());
    return std::move(*opened);
  }

  void Add(const std::vector<std::string>& names, bundle::Bundle& bundle) {
    for (const std::string& name : names) {
      bundle::Piece piece(members_.at(name).size());
      std::copy(members_.at(name).begin(), members_.at(name).end(), piece.bytes().begin());
      ASSERT_TRUE(bundle.Add(name, std::move(piece)).ok()) << name;
    }
  }

  std::map<std::string, std::span<const std::byte>> members_;
};

TEST_F(ArrivingShowTest, TheGuideNeedsOnlyThePlaces) {
  bundle::Bundle bundle = Empty();
  const auto needed = FindNeededMembers(bundle.manifest(), {}, "show");
  ASSERT_TRUE(needed.ok()) << needed.message();
  EXPECT_THAT(needed->guide,
              ::testing::ElementsAre("bar.larscene", "yard.larscene", "wall.larmesh"));
  EXPECT_FALSE(LoadGuideContent(bundle).ok());
  Add(needed->guide, bundle);
  const auto guide = LoadGuideContent(bundle);
  ASSERT_TRUE(guide.ok()) << guide.message();
  EXPECT_EQ(guide->places.size(), 2u);
  EXPECT_TRUE(guide->cast.empty() && guide->objects.empty() && guide->drama.empty());
  EXPECT_TRUE(Show::Create(std::move(guide).value(), {}, *MakeSilentLog()).ok());
}

TEST_F(ArrivingShowTest, IsLoadedFromWhatItNeedsInItsLanguages) {
  const auto pieces_of = [&](const LanguageChoice& languages) {
    bundle::Bundle bundle = Empty();
    const auto needed = FindNeededMembers(bundle.manifest(), languages, "show");
    EXPECT_TRUE(needed.ok()) << needed.message();
    Add(needed->guide, bundle);
    Add(needed->language, bundle);
    EXPECT_FALSE(LoadShowContent(bundle, {}, languages).ok());
    Add(needed->rest, bundle);
    EXPECT_THAT(needed->people, ::testing::IsEmpty());
    const auto content = LoadShowContent(bundle, {}, languages);
    EXPECT_TRUE(content.ok()) << content.message();
    EXPECT_EQ(content->speech.size(), 3u);
    EXPECT_FALSE(content->finer);
    for (const auto& [name, bytes] : members_) {
      bundle.Remove(name);
    }
    EXPECT_FALSE(LoadInLanguages(bundle, languages, *content).ok());
    Add(needed->language, bundle);
    EXPECT_EQ(LoadInLanguages(bundle, languages, *content)->speech.size(), 3u);
    return needed->language;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(pieces_of({}), ElementsAre("la.json", "only_la.json", "d_it.json"));
  EXPECT_THAT(pieces_of({"en", "en"}), ElementsAre("en.json", "only_la.json", "d_en.json"));
  EXPECT_THAT(pieces_of({"en", "off"}), ElementsAre("en.json", "only_la.json", "d_it.json"));
  EXPECT_THAT(pieces_of({"en", "en", true}),
              ::testing::UnorderedElementsAre("en.json", "la.json", "only_la.json", "d_en.json",
                                              "d_it.json"))
      << "of all languages, as a group needs them";
  EXPECT_THAT(FindNeededMembers(Empty().manifest(), {"de", ""}, "show").message(),
              HasSubstr("choose one of: la, en"));
}

// The keeper's body, voice and clips in members of their own.
class ArrivingPeopleTest : public ArrivingShowTest {
 protected:
  void SetUp() override {
    ArrivingShowTest::SetUp();
    human::Human motion = human::RichHuman();
    motion.clips.resize(1);
    Keep(motion, motion_);
    manifest_.cast[0].motion = "keeper.motion.larhuman";
    members_["keeper.motion.larhuman"] = motion_;
    stage::Prop cup = test::MakeCup();
    cup.parts.back().meshes.clear();
    extent_ = stage::SerializeProp(cup);
    manifest_.objects[0].extent = "cup.extent.larprop";
    members_["cup.extent.larprop"] = extent_;
    manifest_.lines[0].spoken["la"].sound = "la.flac";
    members_["la.flac"] = Bytes("a voice");
  }

  static void Keep(human::Human human, std::vector<std::byte>& bytes) {
    human.meshes.clear();
    human.cloths.clear();
    human.light = {};
    for (human::MorphTarget& morph : human.morphs) {
      morph.parts.clear();
    }
    bytes = human::SerializeHuman(human);
  }

  std::vector<std::byte> motion_;
  std::vector<std::byte> extent_;
};

TEST_F(ArrivingPeopleTest, TheDramaBeginsBeforeBodiesAndVoices) {
  bundle::Bundle bundle = Empty();
  const auto needed = FindNeededMembers(bundle.manifest(), {}, "show");
  ASSERT_TRUE(needed.ok()) << needed.message();
  EXPECT_THAT(needed->people, ::testing::ElementsAre("keeper.larhuman"));
  EXPECT_THAT(needed->things, ::testing::ElementsAre("cup.larprop"));
  EXPECT_THAT(needed->voices, ::testing::ElementsAre("la.flac"));
  Add(needed->guide, bundle);
  Add(needed->language, bundle);
  Add(needed->rest, bundle);
  const auto content = LoadShowContent(bundle);
  ASSERT_TRUE(content.ok()) << content.message();
  EXPECT_TRUE(content->cast[0].human->meshes.empty());
  EXPECT_EQ(content->cast[0].human->clips.size(), 1u);
  EXPECT_TRUE(content->speech[0].sound.empty());
  EXPECT_TRUE(content->objects[0].model->prop().parts.back().meshes.empty());

  Add(needed->people, bundle);
  Add(needed->things, bundle);
  Add(needed->voices, bundle);
  human::TexturePool textures;
  const auto objects = LoadObjects(bundle, textures);
  ASSERT_TRUE(objects.ok()) << objects.message();
  EXPECT_FALSE(objects->at(0).model->prop().parts.back().meshes.empty());
  const auto keeper = LoadCastMember(bundle, bundle.manifest().cast[0], 0.0f, textures);
  ASSERT_TRUE(keeper.ok()) << keeper.message();
  EXPECT_EQ(keeper->name, "keeper");
  EXPECT_EQ(keeper->human->meshes.size(), 1u);
  EXPECT_EQ(keeper->model->clips.size(), 1u) << "the body has the clips of the motion";
  EXPECT_FALSE(LoadInLanguages(bundle, {}, *content)->speech[0].sound.empty());
}

TEST_F(ArrivingPeopleTest, TheBodyOfSomebodyElseIsRefused) {
  human::Human other = human::RichHuman();
  other.skeleton.names.back() = "tail";
  Keep(other, motion_);
  members_["keeper.motion.larhuman"] = motion_;
  bundle::Bundle bundle = Empty();
  Add({"keeper.larhuman", "keeper.motion.larhuman"}, bundle);
  human::TexturePool textures;
  EXPECT_THAT(LoadCastMember(bundle, bundle.manifest().cast[0], 0.0f, textures).message(),
              HasSubstr("has other joints than 'keeper.motion.larhuman'"));
}

}  // namespace
}  // namespace lararium::show
