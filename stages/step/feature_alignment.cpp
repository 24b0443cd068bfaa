#include <algorithm>
#include <numeric>

#include "framework/base/error.hpp"
#include "framework/params/values.hpp"
#include "framework/pipeline/hypothesis_choice.hpp"
#include "framework/registration/consistency_graph.hpp"
#include "framework/registration/point_features.hpp"
#include "framework/registration/robust_pose.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::step {
namespace {

struct Params : FeatureOptions, MatchOptions, ConsistencyOptions, HypothesisChoice {
  params::Slot<Preprocessor> feature_thinning;
  double max_range_m = 50.0;
  int min_clique = 5;
  int max_cliques = 100;
  int hypotheses = 16;
};

const params::Table<FeatureOptions>& feature_table() {
  static const params::Table<FeatureOptions> table = {
      params::number("radius_m", &FeatureOptions::radius_m, {0.1, 20.0},
                     "Radius of the surface patch that a feature describes."),
      params::integer("max_neighbours", &FeatureOptions::max_neighbours, {5, 1000},
                      "Maximum number of neighbours per descriptor, the nearest first.")
          .formerly("neighbours"),
      params::integer("normal_neighbours", &FeatureOptions::normal_neighbours, {3, 1000},
                      "Number of neighbours from which a normal of a feature is computed."),
      params::integer("max_features", &FeatureOptions::max_features, {3, 20000},
                      "Maximum number of features per cloud, the least planar first.")
          .formerly("features"),
  };
  return table;
}

const params::Table<MatchOptions>& match_table() {
  static const params::Table<MatchOptions> table = {
      params::number("max_sensor_distance_m", &MatchOptions::max_sensor_distance_m, {0.0, 1000.0},
                     "Maximum distance between the sensor and the reference.")
          .formerly("reach_m"),
      params::integer(
          "candidates", &MatchOptions::candidates, {1, 100},
          "Number of nearest descriptors considered for a feature; matches must be mutual."),
  };
  return table;
}

const params::Table<ConsistencyOptions>& consistency_table() {
  static const params::Table<ConsistencyOptions> table = {
      params::number("tolerance_m", &ConsistencyOptions::tolerance_m, {0.01, 10.0},
                     "Two correspondences agree if the distances of their points in both "
                     "clouds differ by at most this."),
      params::number("normal_tolerance", &ConsistencyOptions::normal_tolerance, {0.0, 2.0},
                     "Likewise for the cosines of the angles between their normals and the line "
                     "through the points; 2: normals are ignored."),
  };
  return table;
}

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("feature_thinning", &Params::feature_thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.4})",
                       "Equalises the density of the clouds before features are computed."),
          params::number("max_range_m", &Params::max_range_m, {1.0, 1000.0},
                         "Points farther from the sensor have no features."),
          params::integer("min_clique", &Params::min_clique, {3, 1000},
                          "Minimum number of mutually consistent correspondences for a pose."),
          params::integer("max_cliques", &Params::max_cliques, {1, 10000},
                          "Maximum number of cliques, each of which proposes a pose.")
              .formerly("cliques"),
          params::integer(
              "hypotheses", &Params::hypotheses, {1, 1000},
              "Number of poses that are refined: those that explain the most correspondences."),
      }
          .inherit(feature_table())
          .inherit(match_table())
          .inherit(consistency_table())
          .inherit(hypothesis_choice_table());
  return table;
}

OrientedPairs pairs_of(const PointFeatures& target, const PointFeatures& source,
                       const std::vector<FeatureMatch>& matches) {
  OrientedPairs pairs;
  for (const FeatureMatch& match : matches) {
    pairs.target.push_back(target.points[match.target]);
    pairs.target_normals.push_back(target.normals[match.target]);
    pairs.source.push_back(source.points[match.source]);
    pairs.source_normals.push_back(source.normals[match.source]);
  }
  return pairs;
}

class FeatureAlignment final : public Step {
 public:
  explicit FeatureAlignment(Params params) : params_(std::move(params)) {}

  static params::DataFlow data_flow(const Params& params) {
    params::DataFlow flow = params.flow();
    flow.add(params.feature_thinning.flow());
    return flow;
  }

  Estimate advance(Estimate estimate, Rng&) const override {
    const auto target = features_of(*estimate.target, "reference");
    const auto source = features_of(*estimate.source, "sensor");
    const auto matches = mutual_matches(*target, *source, params_);
    const OrientedPairs pairs = pairs_of(*target, *source, matches);
    estimate = at_best(std::move(estimate), proposed(pairs), params_);
    estimate.diagnostics.emplace_back("matches", static_cast<double>(pairs.size()));
    std::vector<bool> is_explained(pairs.size(), false);
    estimate.diagnostics.emplace_back("explained",
                                      explained_by(estimate.T_target_source, pairs, is_explained));
    return estimate;
  }

 private:
  std::shared_ptr<const PointFeatures> features_of(const Cloud& cloud, const char* whose) const {
    require_points(cloud, whose);
    const std::string parameters = feature_table().json(params_) + " " +
                                   params_.feature_thinning.resolved() + " " +
                                   params::value_json(params_.max_range_m);
    return cloud.once<PointFeatures>("point_features", parameters, [&] {
      PointCloud near = filtered(cloud.with_channels(), [&](std::size_t i) {
        return cloud.points()[i].cast<double>().norm() <= params_.max_range_m;
      });
      const auto even = cloud.derived(params_.feature_thinning->apply(near), "point_features");
      return std::make_shared<const PointFeatures>(point_features(*even, params_));
    });
  }

  /// One pose per clique, from the densest part of the graph on; each clique has a correspondence
  /// that no earlier pose explains. The score of a pose is the number of correspondences that it
  /// explains.
  std::vector<Hypothesis> proposed(const OrientedPairs& pairs) const {
    const ConsistencyGraph graph(pairs, params_);
    const std::vector<int> cores = graph.core_numbers();
    std::vector<int> seeds(pairs.size());
    std::iota(seeds.begin(), seeds.end(), 0);
    std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return cores[a] > cores[b]; });
    std::vector<bool> is_explained(pairs.size(), false);
    std::vector<Hypothesis> poses;
    std::size_t largest = 0;
    for (const int seed : seeds) {
      if (static_cast<int>(poses.size()) == params_.max_cliques) break;
      if (cores[seed] + 1 < params_.min_clique) break;
      if (is_explained[seed]) continue;
      is_explained[seed] = true;
      const std::vector<int> clique = graph.clique(seed);
      largest = std::max(largest, clique.size());
      if (static_cast<int>(clique.size()) < params_.min_clique) continue;
      try {
        const RigidTransform T = pose_of(pairs, clique);
        poses.push_back({T, explained_by(T, pairs, is_explained)});
      } catch (const StageError&) {
        continue;  // The points of the clique are collinear.
      }
    }
    if (poses.empty()) refuse(pairs.size(), largest);
    sort_by_score(poses);
    poses.resize(std::min(poses.size(), static_cast<std::size_t>(params_.hypotheses)));
    return poses;
  }

  [[noreturn]] void refuse(std::size_t correspondences, std::size_t largest) const {
    throw StageError("of " + std::to_string(correspondences) +
                     " feature correspondences, at most " + std::to_string(largest) +
                     " agree with each other; a pose needs " + std::to_string(params_.min_clique));
  }

  RigidTransform pose_of(const OrientedPairs& pairs, const std::vector<int>& clique) const {
    Points target;
    Points source;
    for (const int i : clique) {
      target.push_back(pairs.target[i]);
      source.push_back(pairs.source[i]);
    }
    return robust_pose(target, source, 0.5 * params_.tolerance_m);
  }

  /// Marks the correspondences that the pose explains, and returns their number.
  double explained_by(const RigidTransform& T, const OrientedPairs& pairs,
                      std::vector<bool>& is_explained) const {
    int count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const Eigen::Vector3d at = T * pairs.source[i].cast<double>();
      if ((at - pairs.target[i].cast<double>()).norm() > 2.0 * params_.tolerance_m) continue;
      is_explained[i] = true;
      ++count;
    }
    return count;
  }

  Params params_;
};

}  // namespace

StageEntry feature_alignment() {
  return stage_entry<FeatureAlignment>(
      "feature_alignment",
      "Finds the pose without an initial guess: matches features, takes poses from cliques of "
      "consistent matches, and chooses among them by overlap and free space.",
      "after TEASER++ (Yang et al., T-RO 2021) and KISS-Matcher (Lim et al., ICRA 2025); FPFH of "
      "Rusu et al., ICRA 2009",
      table(), 2);
}

}  // namespace croon::stages::step
