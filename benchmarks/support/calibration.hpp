#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "benchmarks/support/clouds.hpp"
#include "framework/pipeline/pipeline.hpp"

namespace croon::benchmarks {

/// A pipeline of the tree, and the range of its initial guesses.
struct Method {
  std::string name, file;
  double rotation_deg;  ///< Per axis; 180 means that nothing is known.
};

/// The paper's pipeline and `best.json`.
std::vector<Method> methods();

/// A pose, and whether the method that found it rejects it.
struct Answer {
  RigidTransform T_target_source;
  bool is_rejected = false;
};

/// Calibrations of one pair, each from another initial guess.
class Calibration {
 public:
  Calibration(const Method& method, CloudPair pair);

  /// Replaces the clouds by copies without cached data.
  void forget();

  /// Calibrates from initial guess `trial`, modulo their number. Throws if a step fails.
  Answer run(std::size_t trial);

 private:
  Pipeline pipeline_;
  CloudPair pair_;
  std::vector<RigidTransform> starts_;
  std::shared_ptr<const Cloud> target_, source_;
};

/// Compares answers with the pose of a pair.
class AnswerErrors {
 public:
  void add(const Answer& answer, const CloudPair& pair);

  /// Sets the counters `rotation_deg` and `translation_m`, medians of the errors, `wrong_ratio`,
  /// the share of answers that are beyond 0.5 degrees or 0.1 m and not rejected, and
  /// `rejected_ratio`.
  void set_counters(benchmark::State& state) const;

 private:
  std::vector<double> rotations_deg_, translations_m_;
  int wrong_ = 0, rejected_ = 0;
};

}  // namespace croon::benchmarks
