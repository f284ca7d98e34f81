// SPDX-License-Identifier: MIT
#pragma once

#include "files/temporary_directory.hpp"
#include "live/viewer/answers.hpp"
#include "network/network.hpp"

#include <cstddef>
#include <memory>

namespace rovernet {

struct Scenario;

/// History of a running network, as a recorded trace, so that ViewerAnswers can answer the same
/// questions as for a recorded run. The history begins when this object is made.
///
/// The records are in a temporary folder, in files of `file_size`. Only the last two files are
/// kept; the destructor deletes them. On disk, a reception takes about 4 bytes, and any other
/// record about 50.
class ViewHistory {
  public:
    /// Size of a file [receptions]; each record counts as 12 further receptions.
    static constexpr std::size_t file_size = 30'000'000;

    /// Adds the sink of this object to the network.
    /// @param scenario  scenario of the network; must outlive this object
    /// @throws RunError if the temporary folder cannot be written
    ViewHistory(const Scenario& scenario, std::shared_ptr<Network> network,
                std::size_t size = file_size);
    ~ViewHistory();
    ViewHistory(const ViewHistory&) = delete;  // the destructor removes the sink of this object
    ViewHistory& operator=(const ViewHistory&) = delete;

    /// Trace with all records of a message until now; its path is empty if there are no records.
    IndexedTrace of_message(std::uint64_t uid);
    /// Trace of the last seconds, for questions about the present.
    IndexedTrace of_present();

  private:
    class Records;

    TemporaryDirectory folder_;
    std::shared_ptr<Network> network_;
    std::shared_ptr<Records> records_;
    SinkId sink_;
};

}  // namespace rovernet
