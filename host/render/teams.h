#pragma once

#include <array>
#include <cstdint>

#include "host/device_scene/tuning.h"
#include "host/vk/buffer.h"
#include "host/vk/commands.h"
#include "host/vk/device.h"
#include "host/vk/kernel.h"

namespace duolux {

/// A 64-bit two's complement number as kernels store it.
inline std::int64_t signed64(std::uint32_t low, std::uint32_t high) {
    return static_cast<std::int64_t>(std::uint64_t{high} << 32 | low);
}

/// Distributes the items of a dispatch (pixels, light paths) over teams. A team is a subgroup whose lanes
/// take the items of a range one after the other, so that all lanes stay busy. Two dispatches may be in
/// flight, in the slots 0 and 1.
class Teams {
  public:
    /// `maxItems`: largest number of items in one dispatch.
    Teams(const Device& device, const Tuning& tuning, std::uint32_t maxItems);

    std::uint32_t lanes() const { return lanes_; }        ///< of a team
    const Buffer& progress() const { return progress_; }  ///< shared::TeamProgress
    std::uint32_t firstTeam(unsigned slot) const { return slot * maxItems_; }
    std::uint64_t deviceBytes() const { return progress_.allocated() + read_.allocated(); }

    /// Number of items for each team if a lane may take up to `laneItems` of `items`. With more items, the
    /// lanes of a team wait less for the last one, but there must be enough full teams to keep the device
    /// busy.
    std::uint32_t share(std::uint32_t items, std::uint32_t laneItems) const;

    /// Records a dispatch with `teamItems` items for each team.
    template <typename Push>
    void record(const Commands& commands, const Kernel& kernel, const Push& push, unsigned slot,
                std::uint32_t items, std::uint32_t teamItems) {
        const std::uint32_t teams = begin(commands, slot, items, teamItems);
        kernel.dispatch(commands, push, (teams * lanes_ + workgroupSize_ - 1) / workgroupSize_);
        end(commands, slot);
    }

    /// Whether the driver let all loops of a finished dispatch run to their end.
    bool complete(unsigned slot) const;

  private:
    struct Dispatch {
        std::uint32_t items = 0, teamItems = 1, teams = 0;
    };
    std::uint32_t begin(const Commands& commands, unsigned slot, std::uint32_t items,
                        std::uint32_t teamItems);
    void end(const Commands& commands, unsigned slot) const;

    std::uint32_t lanes_, workgroupSize_, fewestTeams_, maxItems_;
    Buffer progress_, read_;
    std::array<Dispatch, 2> dispatches_{};
};

}  // namespace duolux
