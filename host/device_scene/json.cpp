#include "host/device_scene/json.h"

namespace duolux {

nlohmann::ordered_json toJson(const DeviceInfo& device) {
    return {{"name", device.name}, {"driver", device.driver}, {"kind", nameOf(device.kind)}};
}

nlohmann::ordered_json toJson(const Tuning& tuning) {
    return {{"layout", nameOf(tuning.layout)},
            {"kernel", nameOf(tuning.kernel)},
            {"lanes", tuning.lanes},
            {"workgroup_size", tuning.workgroupSize},
            {"leave_traversal", tuning.leaveTraversal},
            {"leave_traversal_costly", tuning.leaveTraversalCostly},
            {"leave_nodes", tuning.leaveNodes},
            {"vote_by_shuffle", tuning.voteByShuffle},
            {"fewest_teams", tuning.fewestTeams},
            {"lane_paths", tuning.lanePaths},
            {"lane_crossing_paths", tuning.laneCrossingPaths},
            {"lane_rays", tuning.laneRays}};
}

}  // namespace duolux
