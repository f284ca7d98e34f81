// SPDX-License-Identifier: MIT
#pragma once

#include "models/arrival.hpp"
#include "models/radio.hpp"
#include "sim/fields.hpp"
#include "sim/time.hpp"
#include "sim/units.hpp"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

// Interface of physical layers: airtimes, sensitivities and bit error rates. The access model
// chooses a physical layer for its frames. Example without bit errors:
//
//     struct Ideal {
//         static constexpr std::string_view name = "ideal";
//         Transmission transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const {
//             return {.rate = rate, .bandwidth = radio.bandwidth, .preamble = radio.preamble,
//                     .payload = from_seconds(8 * bytes / rate.value), .bytes = bytes};
//         }
//         std::span<const BitRate> rates() const { return known; }  // an array
//         std::optional<Coding> coding(BitRate) const { return Coding{0}; }
//         double log_success(Coding, double) const { return 0; }
//         Db certain_sinr(Coding) const { return Db{-300}; }
//     };

namespace rovernet {

/// Physical layer: transmission parameters of frames, and probabilities that their bits are
/// received correctly. A plain struct with pure functions:
///
/// - `transmission(radio, rate, bytes)`: parameters of a frame of `bytes` at a bit rate [bit/s]
/// - `rates()`: bit rates [bit/s] with known error rates
/// - `coding(rate)`: coding at one of these rates; empty for any other rate
/// - `log_success(coding, sinr)`: natural logarithm of the probability that a bit is received
///   correctly, for an SINR [-] that is constant during the bit
/// - `certain_sinr(coding)`: smallest SINR [dB] at which frames of any length have no bit errors
template <class T>
concept PhysicalLayer = std::copyable<T> &&
    requires(const T& phy, const Radio& radio, BitRate rate, std::uint32_t bytes, Coding coding,
             double sinr) {
    { T::name } -> std::convertible_to<std::string_view>;
    { phy.transmission(radio, rate, bytes) } -> std::same_as<Transmission>;
    { phy.rates() } -> std::convertible_to<std::span<const BitRate>>;
    { phy.coding(rate) } -> std::same_as<std::optional<Coding>>;
    { phy.log_success(coding, sinr) } -> std::same_as<double>;
    { phy.certain_sinr(coding) } -> std::same_as<Db>;
};

// Optional functions of a physical layer.

/// Physical layer whose receivers have a sensitivity for each coding: sensitivity(radio, coding)
/// [dBm] replaces Radio::sensitivity.
template <class T>
concept HasSensitivities = requires(const T& phy, const Radio& radio, Coding coding) {
    { phy.sensitivity(radio, coding) } -> std::same_as<Dbm>;
};
/// Physical layer in which frames of other codings interfere less: rejection(wanted, other) is the
/// fraction [-] of the other frame's power that interferes, 0 ... 1.
template <class T>
concept HasRejection = requires(const T& phy, Coding wanted, Coding other) {
    { phy.rejection(wanted, other) } -> std::same_as<double>;
};
/// Physical layer with its own rule for the detection of preambles: preamble_detection(coding).
template <class T>
concept HasPreambleDetection = requires(const T& phy, Coding coding) {
    { phy.preamble_detection(coding) } -> std::same_as<PreambleDetection>;
};

/// Physical layer of any type, stored by value and shared between copies. Access::phy returns a
/// Phy; the medium, the channel and the judges of receptions use it.
class Phy {
  public:
    /// Stores a physical layer of any type.
    /// @throws std::invalid_argument if a parameter is out of its range
    template <class T>
    requires(!std::same_as<T, Phy> && PhysicalLayer<T>) Phy(T phy)
        : has_sensitivities_(HasSensitivities<T>),
          has_rejection_(HasRejection<T>),
          has_detection_(HasPreambleDetection<T>),
          self_(std::make_shared<Holder<T>>(std::move(phy))) {}

    /// Name of the physical layer.
    std::string_view name() const { return self_->name(); }
    /// Transmission parameters of a frame of `bytes` by a radio, at a bit rate [bit/s].
    Transmission transmission(const Radio& radio, BitRate rate, std::uint32_t bytes) const {
        return self_->transmission(radio, rate, bytes);
    }
    /// Bit rates [bit/s] with known error rates.
    std::span<const BitRate> rates() const { return self_->rates(); }
    /// Coding of frames at a bit rate; empty if the error rates of that bit rate are not known.
    std::optional<Coding> coding(BitRate rate) const { return self_->coding(rate); }
    /// Natural logarithm of the probability that a bit is received correctly. For a frame, values
    /// are summed over bits and over chunks of different sinr [-].
    double log_success(Coding coding, double sinr) const {
        return self_->log_success(coding, sinr);
    }
    /// Smallest SINR [dB] at which frames of any length have no bit errors.
    Db certain_sinr(Coding coding) const { return self_->certain_sinr(coding); }
    /// Whether the sensitivity of receivers depends on the coding of a frame.
    bool has_sensitivities() const { return has_sensitivities_; }
    /// Weakest signal of a coding that `radio` receives [dBm]; by default Radio::sensitivity.
    Dbm sensitivity(const Radio& radio, Coding coding) const {
        return has_sensitivities_ ? self_->sensitivity(radio, coding) : radio.sensitivity;
    }
    /// Fraction of the power of a frame of coding `other` that interferes with a frame of coding
    /// `wanted` [-]; by default 1.
    double rejection(Coding wanted, Coding other) const {
        return has_rejection_ ? self_->rejection(wanted, other) : 1;
    }
    /// Rule for the detection of preambles; by default 4 us after the start of the preamble, with
    /// the threshold of the reception model.
    PreambleDetection preamble_detection(Coding coding) const {
        return has_detection_ ? self_->preamble_detection(coding) : PreambleDetection{};
    }

  private:
    // Interface to the functions of a physical layer of any type.
    struct Concept {
        virtual ~Concept() = default;
        virtual std::string_view name() const = 0;
        virtual Transmission transmission(const Radio&, BitRate, std::uint32_t) const = 0;
        virtual std::span<const BitRate> rates() const = 0;
        virtual std::optional<Coding> coding(BitRate) const = 0;
        virtual double log_success(Coding, double) const = 0;
        virtual Db certain_sinr(Coding) const = 0;
        virtual Dbm sensitivity(const Radio&, Coding) const = 0;
        virtual double rejection(Coding, Coding) const = 0;
        virtual PreambleDetection preamble_detection(Coding) const = 0;
    };
    // Physical layer of type T, with checked parameters.
    template <class T>
    struct Holder final : Concept {
        explicit Holder(T p) : phy(std::move(p)) {
            if constexpr (Described<T>) check_fields(phy, T::name);
        }
        std::string_view name() const override { return T::name; }
        Transmission transmission(const Radio& radio, BitRate rate,
                                  std::uint32_t bytes) const override {
            return phy.transmission(radio, rate, bytes);
        }
        std::span<const BitRate> rates() const override { return phy.rates(); }
        std::optional<Coding> coding(BitRate rate) const override { return phy.coding(rate); }
        double log_success(Coding coding, double sinr) const override {
            return phy.log_success(coding, sinr);
        }
        Db certain_sinr(Coding coding) const override { return phy.certain_sinr(coding); }
        Dbm sensitivity(const Radio& radio, [[maybe_unused]] Coding coding) const override {
            if constexpr (HasSensitivities<T>) return phy.sensitivity(radio, coding);
            return radio.sensitivity;
        }
        double rejection([[maybe_unused]] Coding wanted,
                         [[maybe_unused]] Coding other) const override {
            if constexpr (HasRejection<T>) return phy.rejection(wanted, other);
            return 1;
        }
        PreambleDetection preamble_detection([[maybe_unused]] Coding coding) const override {
            if constexpr (HasPreambleDetection<T>) return phy.preamble_detection(coding);
            return {};
        }
        T phy;
    };
    // Optional functions that the layer has; stored, because a virtual call is slower.
    bool has_sensitivities_, has_rejection_, has_detection_;
    // Physical layer; never null.
    std::shared_ptr<const Concept> self_;
};

}  // namespace rovernet
