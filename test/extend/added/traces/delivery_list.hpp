// SPDX-License-Identifier: MIT
#pragma once

#include "files/part_file.hpp"
#include "sim/record.hpp"
#include "sim/sink.hpp"

#include <functional>
#include <string>

namespace rovernet {

/// Sink that writes the deliveries of a run as CSV: time_s, robot, from, hops.
class DeliveryList {
  public:
    /// Begins the file, which gets its final name when it is complete. @throws RunError if it
    /// cannot be written
    explicit DeliveryList(const std::string& path) : file_(path) {}

    KindMask kinds() const { return kind_of<Received>(); }
    void begin(const RunInfo& run);
    void on(const Record& record, const RecordContext& context);
    void finish() { file_.close(); }
    void give_name() { file_.give_name(); }

  private:
    PartFile file_;
    std::function<std::string_view(NodeId)> name_;
};

}  // namespace rovernet
