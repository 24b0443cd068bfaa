#include <nlohmann/json.hpp>

#include "experiments/report/csv_row.hpp"
#include "experiments/report/export_formats.hpp"

namespace croon::experiments {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const ExportRow& row) {
  Json json = {{"variant", row.variant},
               {"sensor", row.sensor.empty() ? Json() : Json(row.sensor)},
               {"reference", reference_name(row.reference)},
               {"trials", row.trials},
               {"success", row.success},
               {"counted", row.counted}};
  Json best = Json::array();
  Json marks = Json::object();
  for (std::size_t k = 0; k < row.cells.size(); ++k) {
    const ExportCell& cell = row.cells[k];
    const std::string& name = export_columns()[k].name;
    json[name] = cell.value ? Json(*cell.value) : Json();
    if (cell.is_best) best.push_back(name);
    if (!cell.mark.empty()) marks[name] = cell.mark;
  }
  json["best"] = std::move(best);
  json["marks"] = std::move(marks);
  return json;
}

std::string csv_line(const ExportRow& from) {
  CsvRow row;
  row.text(from.variant).text(from.sensor.empty() ? "all" : from.sensor);
  row.text(reference_name(from.reference));
  row.count(from.trials).count(from.success).count(from.counted);
  for (const ExportCell& cell : from.cells) cell.value ? row.number(*cell.value) : row.empty();
  for (const std::size_t k : kMarkedColumns) row.text(from.cells[k].mark);
  return row.line();
}

}  // namespace

std::string export_csv(const ExportTable& table) {
  CsvRow header;
  for (const char* name : {"variant", "sensor", "reference", "trials", "success", "counted"}) {
    header.text(name);
  }
  for (const ExportColumn& column : export_columns()) header.text(column.name);
  for (const std::size_t k : kMarkedColumns) header.text(export_columns()[k].name + "_mark");
  std::string text = header.line();
  for (const ExportRow& row : table.rows) text += csv_line(row);
  return text;
}

std::string export_json(const ExportTable& table) {
  const ExportCaption& caption = table.caption;
  Json json = {{"name", caption.name},
               {"commit", caption.commit},
               {"seed", caption.seed},
               {"scenes", caption.scenes},
               {"sensors", table.sensors.size()},
               {"starts", caption.starts},
               {"trials", caption.found},
               {"planned", caption.planned},
               {"success_bounds",
                {{"rotation_deg", table.bounds.rotation_deg},
                 {"translation_m", table.bounds.translation_m}}},
               {"caption", caption_sentences(table)},
               {"rows", Json::array()}};
  for (const ExportRow& row : table.rows) json["rows"].push_back(json_of(row));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace croon::experiments
