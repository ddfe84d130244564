#pragma once
// Reads the comma-separated tables of tests/data/reference: a header row, # comments, empty cells as NaN.
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/places.hpp"

namespace railstrata {

struct ReferenceRow {
  std::string name;  ///< text of the first column
  std::map<std::string, double> value;
  double at(const std::string& key) const { return value.at(key); }
};

inline std::vector<ReferenceRow> reference_table(const std::string& file) {
  std::ifstream in(source_dir() / "tests/data/reference" / file);
  if (!in) throw std::runtime_error("cannot open " + file);
  std::vector<std::string> header;
  std::vector<ReferenceRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::vector<std::string> cells;
    std::stringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (header.empty()) {
      header = cells;
      continue;
    }
    ReferenceRow row{cells[0], {}};
    for (std::size_t i = 0; i < header.size(); ++i) {
      const bool number =
          i < cells.size() && !cells[i].empty() && std::string("0123456789+-.").find(cells[i][0]) != std::string::npos;
      row.value[header[i]] = number ? std::stod(cells[i]) : std::numeric_limits<double>::quiet_NaN();
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace railstrata
