// SPDX-License-Identifier: MIT
#include "traces/recorded/recorded_trace.hpp"

#include "sim/router.hpp"
#include "traces/record_walk.hpp"
#include "traces/recorded/mcap_writer.hpp"
#include "traces/recorded/record_code.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

namespace rovernet {

/// Copied records that become one chunk.
struct RecordedTrace::Batch {
    /// Message that is defined before the record with that index.
    struct Definition {
        std::size_t before;
        MessageId slot;
        Message message;
    };
    /// Header of the frame in the record with that index.
    struct Header {
        std::size_t before;
        FrameHeader header;
    };
    // A reception takes about 4 bytes in a chunk, any other record about 50.
    static constexpr std::size_t receptions_a_record = 12;

    std::vector<Definition> definitions;
    std::vector<Header> headers;
    /// Records in order; a Received does not point to its receptions, but contains their number.
    std::vector<Record> records;
    std::vector<Reception> receptions;
    /// By slot: uid + 1 of its message, as defined in this batch; 0: none. Every chunk defines all
    /// its messages, so that it can be read without earlier chunks.
    std::vector<std::uint64_t> defined;

    std::size_t size() const { return receptions.size() + receptions_a_record * records.size(); }
    void clear() {
        definitions.clear();
        headers.clear();
        records.clear();
        receptions.clear();
        defined.clear();
    }
    void define(MessageId slot, const RecordContext& context) {
        const Message& message = context.messages[slot];
        if (slot.index() >= defined.size()) defined.resize(slot.index() + 1);
        std::uint64_t& uid = defined[slot.index()];
        if (uid == message.uid + 1) return;
        uid = message.uid + 1;
        definitions.push_back({records.size(), slot, message});
    }
    void add_header(const Record& record, const RecordContext& context) {
        const auto* sent = std::get_if<AirSent>(&record);
        if (!sent || sent->air.control) return;
        if (context.header) headers.push_back({records.size(), *context.header});
        if (sent->air.frame.header == 0 || !context.router) return;
        FrameHeader header = context.router->header_bytes(sent->air.frame);
        if (!header.bytes.empty()) headers.push_back({records.size(), std::move(header)});
    }
};

/// Thread that encodes batches as chunks.
class RecordedTrace::Packer {
  public:
    Packer(const std::string& path, Contents contents)
        : contents_(std::move(contents)),
          file_(path, "rovernet", "rovernet " + contents_.version) {}
    ~Packer() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
            waiting_.clear();
        }
        changed_.notify_all();
        if (thread_.joinable()) thread_.join();
    }

    void begin(const RunInfo& run);
    std::unique_ptr<Batch> empty_batch();
    void hand_over(std::unique_ptr<Batch> batch);
    std::string written();
    void finish();
    void give_name() { file_.give_name(); }

  private:
    static constexpr std::size_t most_waiting = 4;

    void work();
    void pack(Batch& batch);
    void write(const Record& record);

    Contents contents_;
    McapWriter file_;
    McapChunk chunk_;
    Time last_ = start_of_run;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::unique_ptr<Batch>> waiting_;   // of these the thread takes the first
    std::vector<std::unique_ptr<Batch>> emptied_;  // to be used again
    std::exception_ptr error_;
    bool ended_ = false, packs_ = false;
    std::thread thread_;
};

void RecordedTrace::Packer::begin(const RunInfo& run) {
    std::string names, scenario = contents_.scenario;
    if (scenario.empty() && run.scenario) scenario = run.scenario();
    for (NodeId node{0}; node.index() < run.robots; ++node.value) {
        names += run.name(node);
        names += '\n';
    }
    std::map<std::string, std::string> entries{{"format", std::to_string(recorded_format)},
                                               {"version", contents_.version},
                                               {"seed", std::to_string(run.seed)},
                                               {"replication", std::to_string(run.replication)},
                                               {"scenario", scenario}};
    if (!contents_.walls.empty()) entries["walls"] = contents_.walls;
    file_.metadata("rovernet", entries);
    file_.attach({"robots.txt", "text/plain", std::move(names)});
    for (const AttachedFile& file : contents_.files) file_.attach(file);
    contents_.files.clear();
    std::uint16_t channel = message_channel;
    for (const RecordedKind& kind : recorded_kinds())
        file_.declare(channel++, kind.topic, kind.layout);
    const RecordedKind header = recorded_header();
    file_.declare(header_channel, header.topic, header.layout);
    thread_ = std::thread([this] { work(); });
}

/// Returns a batch without records; waits while too many batches are queued.
std::unique_ptr<RecordedTrace::Batch> RecordedTrace::Packer::empty_batch() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || waiting_.size() < most_waiting; });
    if (error_) std::rethrow_exception(error_);
    if (emptied_.empty()) return std::make_unique<Batch>();
    auto batch = std::move(emptied_.back());
    emptied_.pop_back();
    return batch;
}

void RecordedTrace::Packer::hand_over(std::unique_ptr<Batch> batch) {
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(batch));
    }
    changed_.notify_all();
}

/// Waits until all batches are in the file. @return path of the incomplete file
std::string RecordedTrace::Packer::written() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return error_ || (waiting_.empty() && !packs_); });
    if (error_) std::rethrow_exception(error_);
    return file_.part();
}

void RecordedTrace::Packer::finish() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
    if (error_) std::rethrow_exception(error_);
    file_.finish();
}

void RecordedTrace::Packer::work() try {
    for (;;) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return ended_ || !waiting_.empty(); });
        if (waiting_.empty()) return;
        auto batch = std::move(waiting_.front());
        waiting_.pop_front();
        packs_ = true;
        lock.unlock();
        changed_.notify_all();
        pack(*batch);
        batch->clear();
        lock.lock();
        packs_ = false;
        emptied_.push_back(std::move(batch));
        changed_.notify_all();
    }
} catch (...) {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    changed_.notify_all();
}

void RecordedTrace::Packer::pack(Batch& batch) {
    chunk_.clear();
    const Reception* receptions = batch.receptions.data();
    auto definition = batch.definitions.cbegin();
    auto header = batch.headers.cbegin();
    for (std::size_t i = 0; i < batch.records.size(); ++i) {
        Record& record = batch.records[i];
        if (auto* received = std::get_if<Received>(&record)) {
            received->receptions = {receptions, received->receptions.size()};
            receptions += received->receptions.size();
        }
        last_ = time_of(record, last_);
        const auto ns = static_cast<std::uint64_t>(last_.time_since_epoch().count());
        for (; definition != batch.definitions.cend() && definition->before == i; ++definition) {
            chunk_.begin_message(message_channel, ns);
            encode(definition->message, definition->slot, last_, chunk_.bytes());
            chunk_.end_message();
        }
        for (; header != batch.headers.cend() && header->before == i; ++header) {
            chunk_.begin_message(header_channel, ns);
            encode(header->header, chunk_.bytes());
            chunk_.end_message();
        }
        chunk_.begin_message(channel_of(record.index()), ns);
        encode(record, last_, chunk_.bytes());
        chunk_.end_message();
    }
    file_.write(chunk_);
}

RecordedTrace::RecordedTrace(const std::string& path, Contents contents)
    : links_(contents.links),
      chunk_size_(contents.chunk),
      packer_(std::make_unique<Packer>(path, std::move(contents))),
      batch_(packer_->empty_batch()) {}
RecordedTrace::RecordedTrace(RecordedTrace&&) noexcept = default;
RecordedTrace& RecordedTrace::operator=(RecordedTrace&&) noexcept = default;
RecordedTrace::~RecordedTrace() = default;

KindMask RecordedTrace::kinds() const { return links_ ? kind_all : kind_all & ~kind_links; }

void RecordedTrace::begin(const RunInfo& run) { packer_->begin(run); }

void RecordedTrace::on(const Record& record, const RecordContext& context) {
    Batch& batch = *batch_;
    std::visit(
        [&](const auto& r) {
            for_each_in<MessageId>(r, [&](MessageId slot) { batch.define(slot, context); });
        },
        record);
    batch.add_header(record, context);
    batch.records.push_back(record);
    if (const auto* received = std::get_if<Received>(&record)) {
        const auto& all = received->receptions;
        batch.receptions.insert(batch.receptions.end(), all.begin(), all.end());
    }
    if (batch.size() >= chunk_size_) hand_over();
}

void RecordedTrace::hand_over() {
    auto next = packer_->empty_batch();
    packer_->hand_over(std::exchange(batch_, std::move(next)));
    ++chunks_;
}

std::string RecordedTrace::flush() {
    if (!batch_->records.empty()) hand_over();
    return packer_->written();
}

void RecordedTrace::finish() {
    if (!batch_->records.empty()) hand_over();
    packer_->finish();
}

void RecordedTrace::close() { packer_->give_name(); }

}  // namespace rovernet
