// SPDX-License-Identifier: MIT
#pragma once

#include "files/temporary_directory.hpp"
#include "live/viewer/answers.hpp"
#include "network/network.hpp"

#include <cstddef>
#include <memory>

namespace rovernet {

struct Scenario;

/// What has happened in a network that runs, as a recorded trace, so that questions about it have
/// the answers that a recorded run has. It begins when this object is made.
///
/// The records are in a temporary folder, in files of `file_size`. The last two files are kept, and
/// deleted with this object: about 4 bytes on disk for a reception, 50 for any other record.
class ViewHistory {
  public:
    /// Size of a file [receptions]; each record counts as 12 further receptions.
    static constexpr std::size_t file_size = 30'000'000;

    /// Adds its sink to the network.
    /// @param scenario  scenario of the network; must outlive this object
    /// @throws RunError if the temporary folder cannot be written
    ViewHistory(const Scenario& scenario, std::shared_ptr<Network> network,
                std::size_t size = file_size);
    ~ViewHistory();
    ViewHistory(const ViewHistory&) = delete;  // removes its sink
    ViewHistory& operator=(const ViewHistory&) = delete;

    /// Trace with all that is recorded of a message until now; without a path if nothing is.
    IndexedTrace of_message(std::uint64_t uid);
    /// Trace of the present.
    IndexedTrace of_present();

  private:
    class Records;

    TemporaryDirectory folder_;
    std::shared_ptr<Network> network_;
    std::shared_ptr<Records> records_;
    SinkId sink_;
};

}  // namespace rovernet
