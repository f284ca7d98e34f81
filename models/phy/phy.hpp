// SPDX-License-Identifier: MIT
#pragma once

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

// Interface of physical layers: airtimes and bit error rates. The access model chooses one for its
// frames; the MAC uses it for airtimes, reception model "sinr" for error rates. A layer without bit
// errors:
//
//     struct Ideal {
//         static constexpr std::string_view name = "ideal";
//         Duration airtime(Duration preamble, BitRate rate, std::uint32_t bytes) const {
//             return preamble + from_seconds(8 * bytes / rate.value);
//         }
//         std::span<const BitRate> rates() const { return known; }  // an array
//         std::optional<Coding> coding(BitRate) const { return Coding{0}; }
//         double log_success(Coding, double) const { return 0; }
//         Db certain_sinr(Coding) const { return Db{-300}; }
//     };

namespace rovernet {

/// Modulation and coding, as a number within a physical layer.
enum class Coding : std::uint8_t {};

/// Physical layer: airtimes of frames, and probabilities that their bits are right. A plain struct
/// with pure functions.
///
/// - `airtime(preamble, rate, bytes)`: time on air [ns] of a preamble [ns] and `bytes`
/// - `rates()`: bit rates [bit/s] with known error rates
/// - `coding(rate)`: coding of such a rate; empty for another rate
/// - `log_success(coding, sinr)`: natural logarithm of the probability that a bit is right, for a
///   ratio of signal to interference and noise [-] that is constant during the bit
/// - `certain_sinr(coding)`: smallest ratio [dB] at which a frame of any length is right
template <class T>
concept PhysicalLayer = std::copyable<T> &&
    requires(const T& phy, Duration preamble, BitRate rate, std::uint32_t bytes, Coding coding,
             double sinr) {
    { T::name } -> std::convertible_to<std::string_view>;
    { phy.airtime(preamble, rate, bytes) } -> std::same_as<Duration>;
    { phy.rates() } -> std::convertible_to<std::span<const BitRate>>;
    { phy.coding(rate) } -> std::same_as<std::optional<Coding>>;
    { phy.log_success(coding, sinr) } -> std::same_as<double>;
    { phy.certain_sinr(coding) } -> std::same_as<Db>;
};

/// Physical layer of any type, stored by value and shared between copies. Access::phy returns one;
/// the channel and the judges of receptions use it.
class Phy {
  public:
    /// Stores a layer of any type.
    /// @throws std::invalid_argument if a parameter is out of its range
    template <class T>
    requires(!std::same_as<T, Phy> && PhysicalLayer<T>) Phy(T phy)
        : self_(std::make_shared<Holder<T>>(std::move(phy))) {}

    /// Name of the layer.
    std::string_view name() const { return self_->name(); }
    /// Time on air [ns] of `bytes`, including the preamble.
    Duration airtime(Duration preamble, BitRate rate, std::uint32_t bytes) const {
        return self_->airtime(preamble, rate, bytes);
    }
    /// Bit rates [bit/s] with known error rates.
    std::span<const BitRate> rates() const { return self_->rates(); }
    /// Coding of a rate; empty if its error rates are not known.
    std::optional<Coding> coding(BitRate rate) const { return self_->coding(rate); }
    /// Natural logarithm of the probability that a bit is right. For a frame, sum it over bits and
    /// over chunks of different sinr [-].
    double log_success(Coding coding, double sinr) const {
        return self_->log_success(coding, sinr);
    }
    /// Smallest ratio [dB] at which a frame of any length is right.
    Db certain_sinr(Coding coding) const { return self_->certain_sinr(coding); }

  private:
    // Functions of a layer of any type.
    struct Concept {
        virtual ~Concept() = default;
        virtual std::string_view name() const = 0;
        virtual Duration airtime(Duration, BitRate, std::uint32_t) const = 0;
        virtual std::span<const BitRate> rates() const = 0;
        virtual std::optional<Coding> coding(BitRate) const = 0;
        virtual double log_success(Coding, double) const = 0;
        virtual Db certain_sinr(Coding) const = 0;
    };
    // Layer of type T, with checked parameters.
    template <class T>
    struct Holder final : Concept {
        explicit Holder(T p) : phy(std::move(p)) {
            if constexpr (Described<T>) check_fields(phy, T::name);
        }
        std::string_view name() const override { return T::name; }
        Duration airtime(Duration preamble, BitRate rate, std::uint32_t bytes) const override {
            return phy.airtime(preamble, rate, bytes);
        }
        std::span<const BitRate> rates() const override { return phy.rates(); }
        std::optional<Coding> coding(BitRate rate) const override { return phy.coding(rate); }
        double log_success(Coding coding, double sinr) const override {
            return phy.log_success(coding, sinr);
        }
        Db certain_sinr(Coding coding) const override { return phy.certain_sinr(coding); }
        T phy;
    };
    // Never null.
    std::shared_ptr<const Concept> self_;
};

}  // namespace rovernet
