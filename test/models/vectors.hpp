// SPDX-License-Identifier: MIT
#pragma once

#include "models/propagation/propagation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace rovernet::test {

/// Splits a line at its commas; a quoted cell may contain commas.
inline std::vector<std::string> csv_cells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else if (c != '\r') {
            cells.back() += c;
        }
    }
    return cells;
}

/// Table of test vectors: a header, then rows of cells; lines that start with # are comments.
class Vectors {
  public:
    /// @param file  name of a file in test/data
    explicit Vectors(const std::string& file)
        : Vectors(std::string(ROVERNET_TEST_DATA) + "/", file) {}
    /// @param folder  folder, with a slash at its end
    Vectors(const std::string& folder, const std::string& file) {
        std::ifstream in(folder + file);
        for (std::string line; std::getline(in, line);) {
            if (line.empty() || line[0] == '#') continue;
            (header_.empty() ? header_ : rows_.emplace_back()) = csv_cells(line);
        }
        if (rows_.empty()) throw std::runtime_error("no test vectors in " + file);
    }

    std::size_t size() const { return rows_.size(); }
    const std::string& text(std::size_t row, const std::string& column) const {
        const auto found = std::find(header_.begin(), header_.end(), column);
        if (found == header_.end()) throw std::runtime_error("no column " + column);
        return rows_[row].at(static_cast<std::size_t>(found - header_.begin()));
    }
    double number(std::size_t row, const std::string& column) const {
        return std::stod(text(row, column));
    }

  private:
    std::vector<std::string> header_;
    std::vector<std::vector<std::string>> rows_;
};

/// Tolerance of the vectors [dB]. They have 15 digits, so that losses of up to 4079 dB are accurate
/// to 1e-11 dB.
inline constexpr double vector_tolerance = 1e-9;

inline constexpr double no_cutoff = std::numeric_limits<double>::infinity();

/// Link from one transmitter to one receiver.
struct OneLink {
    Hertz frequency{2450e6};
    Vec3 from{};
    Vec3 to{};
    std::uint64_t from_key = 1;
    std::uint64_t to_key = 2;
    const Scene* scene = nullptr;
    std::uint64_t seed = 0;
    std::uint32_t replication = 0;

    /// Loss of the link [dB] by a model.
    double loss(const Propagation& model, double cutoff = no_cutoff) const {
        const Scene open_field;
        double out = std::numeric_limits<double>::quiet_NaN();
        const LinkBatch batch{.frequency = frequency,
                              .from = from,
                              .to = {&to, 1},
                              .from_key = from_key,
                              .to_keys = {&to_key, 1},
                              .scene = scene ? scene : &open_field,
                              .floor_height = {3},
                              .seed = seed,
                              .replication = replication};
        model.loss(batch, {cutoff}, {&out, 1});
        return out;
    }
};

/// Loss [dB] by a model at distance d [m] along the x axis.
inline double loss_at(const Propagation& model, double d, Hertz f = {2450e6}) {
    return OneLink{.frequency = f, .to = {d, 0, 0}}.loss(model);
}

inline bool near(double a, double b, double within) { return std::abs(a - b) <= within; }

}  // namespace rovernet::test
