# Messages and the catkin package; included before any target that uses them.
add_message_files(DIRECTORY msg FILES LineSegment.msg LineMap.msg)
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
catkin_package(INCLUDE_DIRS include
               CATKIN_DEPENDS roscpp geometry_msgs message_runtime std_msgs
               CFG_EXTRAS cca_mrpt-extras.cmake)
