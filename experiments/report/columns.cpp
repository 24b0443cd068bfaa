#include "experiments/report/columns.hpp"

#include "framework/base/text.hpp"
#include "framework/geometry/rigid_transform.hpp"

namespace croon::experiments {

namespace {

Column of_measure(const Measure& measure, const std::string& name, const std::string& path) {
  return {measure.name + ("_" + name), measure.unit, path, measure.decimals,
          Better::nearer_to_zero};
}

}  // namespace

Columns<Share> share_columns(const std::string& name) {
  Columns<Share> columns;
  columns.add({name, "ratio", "/" + name + "/ratio", 1}, &Share::ratio);
  columns.add({name + "_low", "ratio", "/" + name + "/low_ratio", 1},
              [](const Share& share) { return share.interval.low; });
  columns.add({name + "_high", "ratio", "/" + name + "/high_ratio", 1},
              [](const Share& share) { return share.interval.high; });
  return columns;
}

Columns<TrialSummary> outcome_columns() {
  Columns<Outcomes> outcomes;
  outcomes.add({"trials"}, &Outcomes::trials)
      .add({"success", "", "/success/count"}, &Outcomes::success)
      .add({"inaccurate"}, &Outcomes::inaccurate)
      .add({"rejected"}, &Outcomes::rejected)
      .add({"failed"}, &Outcomes::failed);
  Columns<TrialSummary> columns;
  columns.add(outcomes, &TrialSummary::outcomes)
      .add(share_columns("success"), &TrialSummary::success)
      .add({"agreement", "", "/agreement/count"},
           [](const TrialSummary& summary) { return summary.agreement.count; })
      .add(share_columns("agreement"), &TrialSummary::agreement);
  return columns;
}

Columns<std::optional<StatisticsTable>> statistics_columns() {
  Columns<std::optional<StatisticsTable>> columns;
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    for (std::size_t s = 0; s < kStatistics.size(); ++s) {
      const std::string name = kStatistics[s].name;
      columns.add(of_measure(kMeasures[k], name,
                             "/statistics/" + name_with_unit(kMeasures[k]) + "/" + name),
                  [k, s](const auto& table) { return value_of(table, k, s); });
    }
  }
  return columns;
}

Columns<TrialSummary> counted_columns() {
  Columns<TrialSummary> columns;
  columns.add({"counted"}, &TrialSummary::counted);
  return columns.add(statistics_columns(), &TrialSummary::statistics);
}

Columns<std::optional<DofValues>> dof_columns(const std::string& name) {
  Columns<std::optional<DofValues>> columns;
  for (std::size_t k = 0; k < kDofs; ++k) {
    columns.add(of_measure(kMeasures[k], name, "/" + name + "/" + name_with_unit(kMeasures[k])),
                [k](const std::optional<DofValues>& values) {
                  return values ? std::optional<double>((*values)[k]) : std::nullopt;
                });
  }
  return columns;
}

Columns<std::optional<RigidTransform>> pose_columns(const std::string& path) {
  using Pose = std::optional<RigidTransform>;
  Columns<Pose> columns;
  const std::string translation = path + "/translation_m/";
  const std::string rotation = path + "/rotation_xyzw/";
  for (const int i : {0, 1, 2}) {
    columns.add({std::string("t") + "xyz"[i], "m", translation + std::to_string(i)},
                [i](const Pose& pose) {
                  return pose ? std::optional<double>(pose->translation(i)) : std::nullopt;
                });
  }
  for (const int i : {0, 1, 2, 3}) {
    columns.add({std::string("q") + "xyzw"[i], "", rotation + std::to_string(i)},
                [i](const Pose& pose) {
                  return pose ? std::optional<double>(unit_quaternion(pose->rotation).coeffs()(i))
                              : std::nullopt;
                });
  }
  return columns;
}

std::string bounds_text(const SuccessBounds& bounds) {
  return shortest_number(bounds.rotation_deg) + " deg and " +
         shortest_number(bounds.translation_m) + " m of ";
}

std::string column_name(const Measure& measure, const std::string& statistic) {
  return std::string(measure.name) + "_" + statistic + "_" + measure.unit;
}

std::string content_of(const Measure& measure, std::string content) {
  for (std::size_t begin = 0; (begin = content.find('<', begin)) != std::string::npos;) {
    const std::size_t end = content.find('>', begin);
    const std::string name = column_name(measure, content.substr(begin + 1, end - begin - 1));
    content.replace(begin + 1, end - begin - 1, name);
    begin += name.size();
  }
  return content;
}

void add_dofs(View& view, const std::string& content) {
  for (const std::size_t k : kPaperOrder) {
    const Measure& measure = kMeasures[k];
    view.columns.push_back(
        {measure.name + (" " + std::string(measure.unit)), content_of(measure, content)});
  }
}

}  // namespace croon::experiments
