// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rovernet {

/// Writer of a ROS message, value by value, in JSON or CBOR, as the subscription requests.
class RosWriter {
  public:
    virtual ~RosWriter() = default;

    virtual void open_object() = 0;
    virtual void close_object() = 0;
    /// Opens a list of texts or objects. Lists of numbers are written by numbers().
    virtual void open_list() = 0;
    virtual void close_list() = 0;
    /// Writes the key of the next value of an object.
    virtual void key(std::string_view name) = 0;

    virtual void number(double value) = 0;
    virtual void whole(std::int64_t value) = 0;
    virtual void text(std::string_view value) = 0;
    virtual void truth(bool value) = 0;
    virtual void null() = 0;
    /// Writes an array of bytes (ROS type uint8[]).
    virtual void bytes(std::string_view value) = 0;
    virtual void numbers(std::span<const float> values) = 0;
    virtual void numbers(std::span<const double> values) = 0;
    virtual void numbers(std::span<const std::int8_t> values) = 0;
};

/// Writer of JSON, which appends to a text. Numbers have the fewest digits that read back as the
/// same value; numbers that are not finite become null, and bytes become base64.
class RosJsonWriter final : public RosWriter {
  public:
    /// @param out  text to which JSON is appended; must outlive the writer
    explicit RosJsonWriter(std::string& out) : out_(out) {}

    void open_object() override;
    void close_object() override { out_ += '}'; }
    void open_list() override;
    void close_list() override { out_ += ']'; }
    void key(std::string_view name) override;
    void number(double value) override;
    void whole(std::int64_t value) override;
    void text(std::string_view value) override;
    void truth(bool value) override;
    void null() override;
    void bytes(std::string_view value) override;
    void numbers(std::span<const float> values) override;
    void numbers(std::span<const double> values) override;
    void numbers(std::span<const std::int8_t> values) override;

  private:
    void separate();
    template <class Number>
    void list(std::span<const Number> values);

    std::string& out_;
};

/// Writer of CBOR (RFC 8949). Lists of numbers become typed arrays, little-endian (RFC 8746).
class RosCborWriter final : public RosWriter {
  public:
    /// @param out  bytes to which CBOR is appended; must outlive the writer
    explicit RosCborWriter(std::string& out) : out_(out) {}

    void open_object() override;
    void close_object() override;
    void open_list() override;
    void close_list() override;
    void key(std::string_view name) override { text(name); }
    void number(double value) override;
    void whole(std::int64_t value) override;
    void text(std::string_view value) override;
    void truth(bool value) override;
    void null() override;
    void bytes(std::string_view value) override;
    void numbers(std::span<const float> values) override;
    void numbers(std::span<const double> values) override;
    void numbers(std::span<const std::int8_t> values) override;

  private:
    void head(unsigned major, std::uint64_t count);
    template <class Number>
    void typed_array(unsigned tag, std::span<const Number> values);

    std::string& out_;
};

}  // namespace rovernet
