# Messages and the catkin package; included before any target that uses them.
add_message_files(DIRECTORY msg FILES LineSegment.msg LineMap.msg)
add_service_files(DIRECTORY srv FILES DriveToRoom.srv RoomAt.srv)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
# The layers are exported as CMake targets, by cca_mrpt-extras.cmake.
#catkin_lint: ignore missing_export_lib unused_include_path
catkin_package(INCLUDE_DIRS include
               CATKIN_DEPENDS actionlib dynamic_reconfigure geometry_msgs message_runtime move_base_msgs nav_msgs
                              roscpp rosgraph_msgs sensor_msgs std_msgs std_srvs topic_tools visualization_msgs
               CFG_EXTRAS cca_mrpt-extras.cmake)
