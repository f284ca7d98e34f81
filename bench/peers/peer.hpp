// SPDX-License-Identifier: MIT
#pragma once

#include "models/radio.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

/// Common parts of the rovernet programs in bench/peers: options, and the radio of ns-2.

/// Options of the form --name=value on a command line.
class Options {
  public:
    Options(int argc, char** argv) {
        for (int i = 1; i < argc; ++i) {
            const std::string text = argv[i];
            const std::size_t equals = text.find('=');
            if (!text.starts_with("--") || equals == text.npos) {
                fmt::print(stderr, "expected --name=value, got {}\n", text);
                std::exit(2);
            }
            values_[text.substr(2, equals - 2)] = text.substr(equals + 1);
        }
    }
    std::string text(const std::string& name, const std::string& otherwise) const {
        const auto found = values_.find(name);
        return found == values_.end() ? otherwise : found->second;
    }
    double number(const std::string& name, double otherwise) const {
        const auto found = values_.find(name);
        return found == values_.end() ? otherwise : std::atof(found->second.c_str());
    }

  private:
    std::map<std::string, std::string> values_;
};

/// Default radio of ns-2.35: 914 MHz, 0.28183815 W, antenna 1.5 m above flat ground.
inline rovernet::Radio ns2_radio() {
    using rovernet::Dbm;
    rovernet::Radio radio{
        .power = Dbm{24.49999779}, .sensitivity = Dbm{-64.37439}, .frequency = {914e6}};
    radio.carrier_sense_threshold = Dbm{-78.07078};
    radio.rate = {1e6};
    return radio;
}
