#include "shared/geometry/transform.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numbers>
#include <vector>

#include "shared/core/random.h"
#include "shared/geometry/camera_model.h"
#include "shared/geometry/glm_convert.h"

namespace lararium::geometry {
namespace {

Eigen::Vector3d RandomOffset(Random& random, double size = 1.0) {
  return size * Eigen::Vector3d{random.Normal(), random.Normal(), random.Normal()};
}

Rigid3 RandomRigid(Random& random) {
  return {RotationFromVector(RandomOffset(random)), RandomOffset(random, 3.0)};
}

Similarity3 RandomSimilarity(Random& random) {
  return {random.Uniform(0.1, 5.0), RotationFromVector(RandomOffset(random)),
          RandomOffset(random, 3.0)};
}

TEST(Rigid3, InverseAndCompositionActAsMaps) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Rigid3 a_from_b = RandomRigid(random);
    const Rigid3 b_from_c = RandomRigid(random);
    const Eigen::Vector3d point = RandomOffset(random);
    EXPECT_LT(((a_from_b * b_from_c) * point - a_from_b * (b_from_c * point)).norm(), 1e-12);
    EXPECT_LT((a_from_b.Inverse() * (a_from_b * point) - point).norm(), 1e-12);
    EXPECT_LT((a_from_b * a_from_b.Center()).norm(), 1e-12);
    EXPECT_LT((a_from_b.Matrix3x4() * point.homogeneous() - a_from_b * point).norm(), 1e-12);
  }
}

TEST(Similarity3, InverseAndCompositionActAsMaps) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Similarity3 a_from_b = RandomSimilarity(random);
    const Similarity3 b_from_c = RandomSimilarity(random);
    const Eigen::Vector3d point = RandomOffset(random);
    EXPECT_LT(((a_from_b * b_from_c) * point - a_from_b * (b_from_c * point)).norm(), 1e-11);
    EXPECT_LT((a_from_b.Inverse() * (a_from_b * point) - point).norm(), 1e-11);
  }
}

TEST(Similarity3, AreEqualWhereEveryNumberIs) {
  Random random(4);
  const Similarity3 a = RandomSimilarity(random);
  EXPECT_EQ(a, Similarity3(a));
  for (int which = 0; which < 3; ++which) {
    Similarity3 b = a;
    if (which == 0) {
      b.scale *= 1.0 + 1e-12;
    } else if (which == 1) {
      b.rotation.coeffs() = -b.rotation.coeffs();  // same rotation
    } else {
      b.translation.z() += 1e-12;
    }
    EXPECT_NE(a, b) << which;
  }
}

TEST(Rigid3, AreEqualWhereEveryNumberIs) {
  Random random(5);
  const Rigid3 a = RandomRigid(random);
  Rigid3 b = a;
  EXPECT_EQ(a, b);
  b.translation.x() += 1e-12;
  EXPECT_NE(a, b);
  b = a;
  b.rotation.w() += 1e-12;
  EXPECT_NE(a, b);
}

TEST(CameraFromB, IsRigidAndProjectsToTheSamePixel) {
  Random random(3);
  const CameraModel camera{640, 480, 500, 510, 320, 240, -0.1, 0.02, 1e-3, -1e-3};
  for (int i = 0; i < 100; ++i) {
    const Similarity3 map_from_stage = RandomSimilarity(random);
    const Rigid3 camera_from_map = RandomRigid(random);
    const Eigen::Vector3d in_camera{random.Uniform(-0.5, 0.5), random.Uniform(-0.4, 0.4), 1.0};
    const Eigen::Vector3d in_map = camera_from_map.Inverse() * (7.0 * in_camera);
    const Eigen::Vector3d in_stage = map_from_stage.Inverse() * in_map;
    const Rigid3 camera_from_stage = CameraFromB(camera_from_map, map_from_stage);
    EXPECT_NEAR(camera_from_stage.rotation.norm(), 1.0, 1e-12);
    EXPECT_LT(
        (*camera.Project(camera_from_stage * in_stage) - *camera.Project(camera_from_map * in_map))
            .norm(),
        1e-8);
  }
}

TEST(EstimateSimilarity, RecoversTheTransform) {
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Similarity3 truth = RandomSimilarity(random);
    std::vector<Eigen::Vector3d> in_a;
    std::vector<Eigen::Vector3d> in_b;
    for (int k = 0; k < 3 + i; ++k) {
      in_b.push_back(RandomOffset(random));
      in_a.push_back(truth * in_b.back());
    }
    const Similarity3 found = EstimateSimilarity(in_a, in_b).value();
    EXPECT_NEAR(found.scale, truth.scale, 1e-9);
    EXPECT_LT(found.rotation.angularDistance(truth.rotation), 1e-6);
    EXPECT_LT((found.translation - truth.translation).norm(), 1e-9);
  }
}

TEST(EstimateSimilarity, NeverReturnsAReflection) {
  Random random(5);
  std::vector<Eigen::Vector3d> in_a;
  std::vector<Eigen::Vector3d> in_b;
  for (int k = 0; k < 10; ++k) {
    in_b.push_back(RandomOffset(random));
    in_a.emplace_back(-in_b.back().x(), in_b.back().y(), in_b.back().z());
  }
  EXPECT_NEAR(EstimateSimilarity(in_a, in_b).value().rotation.toRotationMatrix().determinant(), 1.0,
              1e-9);
}

TEST(EstimateSimilarity, RefusesPointsOnALine) {
  std::vector<Eigen::Vector3d> line;
  for (int k = 0; k < 5; ++k) {
    line.emplace_back(k, 2 * k, -k);
  }
  EXPECT_FALSE(EstimateSimilarity(line, line).ok());
  line.resize(2);
  EXPECT_FALSE(EstimateSimilarity(line, line).ok());
}

TEST(ClosestRotation, IsTheRotationOfANoisyOneAndNeverAMirror) {
  Random random(8);
  const Eigen::Quaterniond rotation = RandomRigid(random).rotation;
  EXPECT_LT(ClosestRotation(3.0 * rotation.toRotationMatrix()).angularDistance(rotation), 1e-9);
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1.0, 1.0, -0.5).asDiagonal();
  EXPECT_LT(ClosestRotation(rotation.toRotationMatrix() * mirror).angularDistance(rotation), 1e-9);
}

TEST(RotationBetween, TurnsOneDirectionIntoTheOtherAlsoWhereTheyAreOpposite) {
  Random random(9);
  const Eigen::Vector3d b = RandomOffset(random);
  for (const Eigen::Vector3d& a : {RandomOffset(random), b, Eigen::Vector3d(-2.0 * b)}) {
    EXPECT_LT((RotationBetween(a, b) * b.normalized() - a.normalized()).norm(), 1e-7);
  }
}

TEST(RotationVector, IsInverseOfItsRotation) {
  Random random(6);
  for (const double size : {0.0, 1e-12, 1e-7, 1e-3, 1.0, std::numbers::pi - 1e-6}) {
    const Eigen::Vector3d w = size * RandomOffset(random).normalized();
    const Eigen::Quaterniond rotation = RotationFromVector(w);
    EXPECT_LT((VectorFromRotation(rotation) - w).norm(), 1e-9) << size;
    Eigen::Quaterniond opposite = rotation;
    opposite.coeffs() *= -1.0;
    EXPECT_LT((VectorFromRotation(opposite) - w).norm(), 1e-9) << size;
  }
}

TEST(Skew, IsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(-2, 0.5, 4);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(GlmConvert, KeepsTheMap) {
  Random random(7);
  const Similarity3 a_from_b = RandomSimilarity(random);
  const Eigen::Vector3d point = RandomOffset(random);
  const glm::vec4 moved = ToGlm(a_from_b) * glm::vec4(ToGlm(point), 1.0f);
  EXPECT_LT((ToEigen(glm::vec3(moved)) - a_from_b * point).norm(), 1e-4);
  EXPECT_LT(ToEigen(ToGlm(a_from_b.rotation)).angularDistance(a_from_b.rotation), 1e-3);
}

}  // namespace
}  // namespace lararium::geometry
