// Vessels in which the kitchen keeps, pours and serves.

#include <glm/gtc/quaternion.hpp>

#include "editor/import/objects/workshop.h"

namespace lararium::import {

stage::Prop OnePiece(std::string name, stage::PropMesh mesh) {
  stage::Prop prop;
  prop.name = std::move(name);
  prop.parts.push_back({"body", stage::PropPart::kNoParent, {}, {std::move(mesh)}});
  return prop;
}

void AddPart(std::string name, const glm::vec3& origin, stage::PropMesh mesh, stage::Prop& prop) {
  prop.parts.push_back({std::move(name), 0, {origin}, {std::move(mesh)}});
}

stage::PropMesh Potted(std::vector<OutlinePoint> outline_cm, const Paint& paint) {
  for (OutlinePoint& point : outline_cm) {
    point.radius *= 0.01f;
    point.height *= 0.01f;
  }
  return Turned(outline_cm, paint, 0.0012f);
}

stage::PropMesh BentRod(std::vector<glm::vec3> points_cm, float radius_cm, const Paint& paint) {
  std::vector<PathPoint> path;
  for (const glm::vec3& point : points_cm) {
    path.push_back({0.01f * point, 0.01f * radius_cm});
  }
  return Rod(path, paint);
}

namespace model {
// A Dressel 2-4 amphora for wine, in a ring of clay that keeps it upright.
stage::Prop Amphora() {
  const Paint clay = ClayPaint(kPaleClay, 11);
  stage::PropMesh mesh = Potted({{0, 4},
                                 {2.6f, 5},
                                 {3.2f, 9},
                                 {8, 22},
                                 {12.5f, 38},
                                 {14.5f, 55},
                                 {14.8f, 66, true},
                                 {10, 71},
                                 {6, 76},
                                 {5.2f, 88},
                                 {6.4f, 97},
                                 {7.2f, 99, true},
                                 {7.2f, 101, true},
                                 {5, 101, true},
                                 {4.4f, 88},
                                 {4.6f, 76},
                                 {0, 68}},
                                clay);
  for (const float side : {-1.0f, 1.0f}) {
    Append(BentRod({{side * 5.0f, 93, 0},
                    {side * 10.5f, 94.5f, 0},
                    {side * 13.0f, 90, 0},
                    {side * 13.6f, 78, 0},
                    {side * 13.2f, 66, 0}},
                   1.5f, clay),
           mesh);
  }
  Append(Potted({{9, 0, true},
                 {12, 0, true},
                 {11, 7},
                 {12.5f, 14, true},
                 {10.5f, 14, true},
                 {9, 7},
                 {9, 0}},
                ClayPaint(kTerracotta, 12)),
         mesh);
  return OnePiece("amphora", std::move(mesh));
}

// A jar of coarse ware with a removable lid.
stage::Prop StorageJar() {
  const Paint clay = ClayPaint(kTerracotta, 21);
  stage::Prop prop = OnePiece("storage_jar", Potted({{0, 0},
                                                     {8, 0, true},
                                                     {13, 8},
                                                     {16.5f, 18},
                                                     {16, 27},
                                                     {11.5f, 33},
                                                     {11, 35},
                                                     {12.6f, 37, true},
                                                     {12, 38, true},
                                                     {10.5f, 37, true},
                                                     {9.8f, 34},
                                                     {14.6f, 26},
                                                     {15, 18},
                                                     {11, 6},
                                                     {0, 2}},
                                                    clay));
  AddPart("lid", {0.0f, 0.372f, 0.0f},
          Potted({{0, 0},
                  {10.2f, 0, true},
                  {12.4f, 0.4f, true},
                  {12.2f, 1.3f, true},
                  {8, 3},
                  {2.4f, 4.6f, true},
                  {1.8f, 5.4f},
                  {2.6f, 7},
                  {1.6f, 7.8f},
                  {0, 8}},
                 ClayPaint(kTerracotta, 22)),
          prop);
  return prop;
}

// An urceus: pinched lip in front, handle behind.
stage::Prop Jug() {
  const Paint clay = ClayPaint(glm::vec3(0.50f, 0.27f, 0.15f), 31);
  stage::PropMesh mesh = Potted({{0, 0},
                                 {4.5f, 0, true},
                                 {5, 0.8f, true},
                                 {8, 6},
                                 {8.8f, 11},
                                 {7, 16.5f},
                                 {3.6f, 20},
                                 {3.2f, 22},
                                 {4.4f, 25, true},
                                 {4.1f, 25.4f, true},
                                 {3.0f, 22},
                                 {3.2f, 20},
                                 {6.4f, 16},
                                 {8, 11},
                                 {0, 1}},
                                clay);
  for (glm::vec3& p : mesh.positions) {
    // The lip is extended to the front and pressed in beside it.
    const float high = glm::smoothstep(0.215f, 0.25f, p.y);
    const float front = glm::smoothstep(0.0f, 0.04f, -p.z);
    p.z -= 0.022f * high * front;
    p.x *= 1.0f - 0.35f * high * front;
  }
  Append(BentRod({{0, 24, 3.6f}, {0, 25.5f, 7}, {0, 23, 9.8f}, {0, 17, 10.2f}, {0, 12.5f, 8.4f}},
                 0.9f, clay),
         mesh);
  return OnePiece("jug", std::move(mesh));
}

// A simpulum: the bowl hangs on an upright handle with a hook.
stage::Prop Ladle() {
  const Paint bronze = MetalPaint(kBronze, kPatina, 41);
  stage::PropMesh mesh = Potted({{0, 0},
                                 {2.4f, 0.4f},
                                 {3.6f, 2},
                                 {3.9f, 4, true},
                                 {3.7f, 4, true},
                                 {3.4f, 2},
                                 {2.2f, 0.7f},
                                 {0, 0.3f}},
                                bronze);
  Append(BentRod({{3.7f, 3.8f, 0},
                  {4.2f, 6, 0},
                  {4.2f, 18, 0},
                  {4.2f, 32, 0},
                  {3.4f, 35, 0},
                  {1.4f, 35.5f, 0},
                  {0.8f, 33.5f, 0}},
                 0.32f, bronze),
         mesh);
  return OnePiece("ladle", std::move(mesh));
}

// A footed cup of red gloss ware.
stage::Prop Cup() {
  return OnePiece("cup", Potted({{0, 0.4f},
                                 {2.0f, 0.4f, true},
                                 {2.4f, 0, true},
                                 {2.7f, 0, true},
                                 {2.4f, 1},
                                 {4.2f, 2.4f},
                                 {5.0f, 4.4f},
                                 {5.2f, 6.2f, true},
                                 {4.9f, 6.3f, true},
                                 {4.7f, 4.4f},
                                 {3.9f, 2.8f},
                                 {0, 1.6f}},
                                ClayPaint(kSigillata, 51)));
}

// A beaker of thin-walled ware.
stage::Prop Beaker() {
  return OnePiece("beaker", Potted({{0, 0},
                                    {2.1f, 0, true},
                                    {2.4f, 0.5f},
                                    {3.9f, 4},
                                    {4.2f, 7},
                                    {3.6f, 9.6f},
                                    {3.9f, 10.8f, true},
                                    {3.7f, 10.9f, true},
                                    {3.4f, 9.6f},
                                    {3.9f, 7},
                                    {3.6f, 4},
                                    {0, 0.8f}},
                                   ClayPaint(glm::vec3(0.36f, 0.25f, 0.18f), 61)));
}

stage::Prop Bowl() {
  return OnePiece("bowl", Potted({{0, 0.5f},
                                  {3.2f, 0.5f, true},
                                  {3.7f, 0, true},
                                  {4.2f, 0, true},
                                  {4.0f, 1},
                                  {8, 3},
                                  {10, 6.2f},
                                  {10.6f, 6.8f, true},
                                  {10.3f, 7.2f, true},
                                  {9.4f, 6.3f},
                                  {7.4f, 3.5f},
                                  {0, 1.8f}},
                                 ClayPaint(kTerracotta, 71)));
}

// A plate of figs.
stage::Prop Plate() {
  stage::PropMesh mesh = Potted({{0, 0.6f},
                                 {5, 0.6f, true},
                                 {5.5f, 0, true},
                                 {6.2f, 0, true},
                                 {6.2f, 0.8f},
                                 {11, 1.8f},
                                 {12.2f, 3.2f, true},
                                 {11.8f, 3.4f, true},
                                 {10.6f, 2.3f},
                                 {6, 1.4f},
                                 {0, 1.3f}},
                                ClayPaint(kSigillata, 81));
  const stage::PropMesh fig = Potted(
      {{0, 0}, {1.3f, 0.3f}, {2.0f, 1.6f}, {1.7f, 3.0f}, {0.7f, 4.0f}, {0.3f, 5.0f}, {0, 5.1f}},
      MetalPaint({0.085f, 0.045f, 0.075f}, {0.12f, 0.13f, 0.045f}, 82));
  const float kPlaces[][3] = {{0.0f, 0.0f, 0.3f},      {0.044f, 0.01f, 1.1f},
                              {-0.041f, 0.022f, 2.0f}, {-0.01f, -0.046f, 0.0f},
                              {0.03f, -0.035f, 4.0f},  {0.012f, 0.046f, 5.2f}};
  for (const auto& [x, z, turn] : kPlaces) {
    const glm::quat lean =
        glm::angleAxis(turn, glm::vec3(0, 1, 0)) * glm::angleAxis(0.5f, glm::vec3(1, 0, 0));
    Append(fig, mesh, {{x, 0.017f, z}, lean});
  }
  return OnePiece("plate", std::move(mesh));
}

// A mortarium with its pestle.
stage::Prop Mortar() {
  stage::PropMesh mesh = Potted({{0, 0},
                                 {7, 0, true},
                                 {7.4f, 1},
                                 {11, 6},
                                 {12.4f, 9.4f},
                                 {14.6f, 9.8f, true},
                                 {14.8f, 8.2f, true},
                                 {15.4f, 8.4f},
                                 {15.2f, 11, true},
                                 {12.2f, 11.4f, true},
                                 {10.6f, 9},
                                 {8, 4.4f},
                                 {0, 2.4f}},
                                StonePaint(glm::vec3(0.40f, 0.37f, 0.32f), 91));
  Append(Rod(std::vector<PathPoint>{{{0.0f, 0.045f, 0.0f}, 0.022f},
                                    {{0.03f, 0.08f, 0.01f}, 0.015f},
                                    {{0.10f, 0.17f, 0.04f}, 0.014f},
                                    {{0.12f, 0.20f, 0.05f}, 0.018f}},
             WoodPaint(kOak, 1, 92)),
         mesh);
  return OnePiece("mortar", std::move(mesh));
}

// A situla with a swinging bail.
stage::Prop Bucket() {
  const Paint bronze = MetalPaint(kBronze, kPatina, 101);
  stage::Prop prop = OnePiece("bucket", Potted({{0, 0.6f},
                                                {8, 0.6f, true},
                                                {8.4f, 0, true},
                                                {9, 0, true},
                                                {9, 1},
                                                {11.4f, 12},
                                                {12.2f, 22},
                                                {11.8f, 24},
                                                {12.6f, 25, true},
                                                {12.2f, 25.4f, true},
                                                {11.3f, 24},
                                                {11.6f, 22},
                                                {10.8f, 12},
                                                {0, 1.4f}},
                                               bronze));
  AddPart("bail", {0.0f, 0.245f, 0.0f},
          BentRod({{-12.4f, 0, 0},
                   {-12.2f, 6, 0},
                   {-8.5f, 11.5f, 0},
                   {0, 13.6f, 0},
                   {8.5f, 11.5f, 0},
                   {12.2f, 6, 0},
                   {12.4f, 0, 0}},
                  0.45f, bronze),
          prop);
  return prop;
}

}  // namespace model
}  // namespace lararium::import
