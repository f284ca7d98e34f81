// SPDX-License-Identifier: MIT
#include "live/rosbridge/types.hpp"

#include <algorithm>
#include <array>
#include <sstream>

namespace rovernet {
namespace {

// Source: the .msg files of ROS 2 Humble (common_interfaces, rcl_interfaces, geometry2), members
// only.
constexpr std::array<RosType, 23> types = {{
    {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    {"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"},
    {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    {"geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"},
    {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    {"geometry_msgs/Transform",
     "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    {"geometry_msgs/TransformStamped",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    {"nav_msgs/Odometry",
     "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
     "geometry_msgs/TwistWithCovariance twist\n"},
    {"nav_msgs/MapMetaData",
     "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
     "geometry_msgs/Pose origin\n"},
    {"nav_msgs/OccupancyGrid", "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
    {"sensor_msgs/LaserScan",
     "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
     "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
     "float32[] ranges\nfloat32[] intensities\n"},
    {"rovernet_msgs/Received",
     "builtin_interfaces/Time stamp\nstring src_address\nstring last_hop\nstring dst_address\n"
     "uint16 dst_port\nuint16 hops\nfloat64 rssi\nfloat64 noise\nuint8[] data\n"},
    {"rovernet_msgs/Neighbor",
     "string address\nstring ip\nstring mac\nstring essid\nfloat64 frequency\nfloat64 rssi\n"
     "float64 noise\nuint8 quality\nbuiltin_interfaces/Time last_heard\n"},
    {"rovernet_msgs/Neighbors", "std_msgs/Header header\nrovernet_msgs/Neighbor[] neighbors\n"},
    {"rovernet_msgs/Send", "string dst_address\nuint16 dst_port\nuint8[] data\nuint16 size\n"},
}};

RosMember read_member(const std::string& type, const std::string& name) {
    const std::size_t bracket = type.find('[');
    if (bracket == type.npos) return {type, name, std::nullopt};
    const std::string number = type.substr(bracket + 1, type.size() - bracket - 2);
    return {type.substr(0, bracket), name, number.empty() ? 0 : std::stoi(number)};
}

}  // namespace

std::vector<RosMember> RosType::members() const {
    std::istringstream words{std::string(definition)};
    std::vector<RosMember> all;
    for (std::string type, member; words >> type >> member;) {
        all.push_back(read_member(type, member));
    }
    return all;
}

const RosType* find_type(std::string_view name) {
    const auto found = std::find_if(types.begin(), types.end(),
                                    [&](const RosType& type) { return type.name == name; });
    return found == types.end() ? nullptr : &*found;
}

std::vector<const RosType*> types_within(const RosType& type) {
    std::vector<const RosType*> all = {&type};
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const RosMember& member : all[i]->members()) {
            const RosType* inner = find_type(member.type);
            if (inner && std::find(all.begin(), all.end(), inner) == all.end()) {
                all.push_back(inner);
            }
        }
    }
    return all;
}

}  // namespace rovernet
