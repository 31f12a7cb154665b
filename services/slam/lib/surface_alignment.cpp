#include "services/slam/lib/surface_alignment.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "services/slam/lib/nearest_depth.hpp"

namespace tsg {
namespace {

constexpr int kAlignmentSteps = 28;
constexpr double kFirstGate = 0.3;    // metres: how far patches may lie apart at first ...
constexpr double kLastGate = 0.05;    // ... and in the end
constexpr double kGateShrink = 0.92;  // per iteration
constexpr int kWideIterations = 14;   // with few patches that look for partners around them
constexpr int kFirstReach = 8;        // cells
constexpr int kReachStep = 2;         // cells
constexpr int kFirstStride = 8;       // patches
constexpr double kMiddleGate = 0.12;  // metres, of all patches, with the partner in front of them
constexpr double kMinScatter = 0.1;   // so a rare direction weighs ten times the usual at most
constexpr double kMinNormalCosine = 0.8;  // 37 degrees: a turn between frames and noise
constexpr double kSurfaceHuber = 1.5;     // standard deviations
constexpr double kFitSigmas = 3.0;   // further from the plane a patch speaks against the alignment
constexpr double kMinSigma = 0.003;  // metres: registration and lens, whatever the distance
constexpr double kIndependent = 0.02;  // neighbouring samples err alike: share that counts
constexpr double kStartSigma = 0.1;    // metres and radians: how good the start is
constexpr double kAligned = 1e-5;      // metres and radians
constexpr int kMinPairs = 300;         // of some 7000: a twentieth of the image
constexpr std::array kSlides = {-0.2, -0.1, 0.1, 0.2};  // metres or radians

struct Sum {
  Matrix6d H = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  int seen = 0;    ///< patches that fall where the reference has one
  int paired = 0;  ///< of these, with a partner near them
  int fits = 0;    ///< of these, in their partner's plane
};

/// How one iteration looks for partners.
struct Search {
  double gate = 0.0;  ///< metres
  int reach = 0;      ///< cells beside the projection
  int stride = 1;     ///< takes one patch of so many
};

/// Weighs patches by how few others face their way: a wall of thousands tells no more about the
/// motion than the few patches that keep it from sliding (Rusinkiewicz and Levoy 2001).
Eigen::Matrix3d scatter_of_normals(const PatchGrid& grid) {
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const SurfacePatch& patch : grid.patches()) {
    scatter += patch.normal * patch.normal.transpose();
  }
  return 3.0 * scatter / static_cast<double>(grid.patches().size());
}

/// The nearest patch that faces the same way.
const SurfacePatch* find_partner(const PatchGrid& grid,
                                 const SurfacePatch& patch,
                                 const Eigen::Vector2d& pixel,
                                 const Search& search) {
  const SurfacePatch* best = nullptr;
  double least = search.gate * search.gate;
  for (int y = -search.reach; y <= search.reach; y += kReachStep) {
    for (int x = -search.reach; x <= search.reach; x += kReachStep) {
      const SurfacePatch* other = grid.find(pixel, x, y);
      if (other == nullptr || other->normal.dot(patch.normal) < kMinNormalCosine) continue;
      const double distance = (other->point - patch.point).squaredNorm();
      if (distance > least) continue;
      least = distance;
      best = other;
    }
  }
  return best;
}

class Aligner {
 public:
  Aligner(const ObservationModel& model, const PatchGrid& reference, const PatchGrid& camera)
      : model_(model),
        reference_(reference),
        camera_(camera),
        scatter_(scatter_of_normals(camera)) {}

  [[nodiscard]] Sum sum_up(const SE3& T_camera_reference, const Search& search) const {
    Sum sum;
    const SE3 T_reference_camera = T_camera_reference.inverse();
    const Eigen::Matrix3d R_reference_camera = T_reference_camera.rotation_matrix();
    for (std::size_t i = 0; i < camera_.patches().size();
         i += static_cast<std::size_t>(search.stride)) {
      const SurfacePatch& patch = camera_.patches()[i];
      const SurfacePatch moved{R_reference_camera * patch.point + T_reference_camera.translation(),
                               R_reference_camera * patch.normal};
      if (moved.point.z() < kMinDepth) continue;
      const Eigen::Vector2d pixel = model_.camera().project(moved.point);
      if (reference_.find(pixel) != nullptr) ++sum.seen;
      const SurfacePatch* partner = find_partner(reference_, moved, pixel, search);
      if (partner == nullptr) continue;
      add_pair(patch, R_reference_camera.transpose() * partner->normal,
               partner->normal.dot(moved.point - partner->point), sum);
    }
    return sum;
  }

  [[nodiscard]] double patches() const { return static_cast<double>(camera_.patches().size()); }

 private:
  /// `normal` is the partner's, in the camera's frame; `distance` that to the partner's plane.
  void add_pair(const SurfacePatch& patch,
                const Eigen::Vector3d& normal,
                double distance,
                Sum& sum) const {
    const double z = patch.point.z();
    const double sigma = std::max(kMinSigma, model_.inverse_depth_sigma() * z * z);
    const double residual = distance / sigma;
    const double rarity = 1.0 / std::max(kMinScatter, normal.dot(scatter_ * normal));
    const double weight = rarity * std::min(1.0, kSurfaceHuber / std::abs(residual));
    Vector6d J;
    J << -normal, -patch.point.cross(normal);
    J /= sigma;
    sum.H.noalias() += weight * J * J.transpose();
    sum.b.noalias() -= weight * residual * J;
    ++sum.paired;
    if (std::abs(residual) <= kFitSigmas) ++sum.fits;
  }

  const ObservationModel& model_;
  const PatchGrid& reference_;
  const PatchGrid& camera_;
  Eigen::Matrix3d scatter_;
};

/// The alignment that is reached from one start.
std::optional<SurfaceAlignment> descend(const Aligner& aligner, const SE3& T_camera_reference) {
  SurfaceAlignment alignment{.T_camera_reference = T_camera_reference};
  const double start_weight = 1.0 / (kIndependent * kStartSigma * kStartSigma);
  Search search{.gate = kFirstGate, .reach = kFirstReach, .stride = kFirstStride};
  for (int i = 0; i < kAlignmentSteps; ++i) {
    if (i == kWideIterations) search = {.gate = kMiddleGate};
    const Sum sum = aligner.sum_up(alignment.T_camera_reference, search);
    if (sum.paired * search.stride < kMinPairs) return std::nullopt;
    const Vector6d moved = (alignment.T_camera_reference * T_camera_reference.inverse()).log();
    const double damping = start_weight / search.stride;
    const Matrix6d H = sum.H + damping * Matrix6d::Identity();
    const Vector6d step = H.ldlt().solve(sum.b - damping * moved);
    alignment.T_camera_reference = SE3::exp(step) * alignment.T_camera_reference;
    if (search.gate <= kLastGate && step.norm() < kAligned) break;
    search.gate = std::max(kLastGate, search.gate * kGateShrink);
  }
  const Sum sum = aligner.sum_up(alignment.T_camera_reference, {.gate = kLastGate});
  if (sum.paired < kMinPairs) return std::nullopt;
  alignment.information = kIndependent * sum.H;
  alignment.overlap = static_cast<double>(sum.seen) / aligner.patches();
  alignment.agreement = static_cast<double>(sum.fits) / static_cast<double>(sum.seen);
  return alignment;
}

/// The direction in which the surfaces hold the pose least.
Vector6d weakest_direction(const SurfaceAlignment& alignment) {
  return Eigen::SelfAdjointEigenSolver<Matrix6d>(alignment.information).eigenvectors().col(0);
}

}  // namespace

std::optional<SurfaceAlignment> align_surfaces(const ObservationModel& model,
                                               const PatchGrid& reference,
                                               const PatchGrid& camera,
                                               const SE3& T_camera_reference) {
  if (static_cast<int>(camera.patches().size()) < kMinPairs) return std::nullopt;
  const Aligner aligner(model, reference, camera);
  auto best = descend(aligner, T_camera_reference);
  if (!best || best->agreement >= kGoodAgreement) return best;
  // Long walls hold on to each other where they are: look along them for the place where the
  // corners of the room fit too.
  const SurfaceAlignment first = *best;
  const Vector6d direction = weakest_direction(first);
  for (const double slide : kSlides) {
    const auto other = descend(aligner, SE3::exp(slide * direction) * first.T_camera_reference);
    if (other && other->agreement > best->agreement) best = other;
  }
  return best;
}

}  // namespace tsg
