/* Subscribes to the pose topics as a ROS 2 node would (rmw_cyclonedds: names, QoS, encoding) with
   types of its own, prints the first sample of each, and exits 0 once it has all three, 1 where
   they do not come in ten seconds. Shares no code with the project. */
#include <dds/dds.h>
#include <stdio.h>

#include "ros2_types.h"

typedef geometry_msgs_msg_dds__Pose_ Pose;

static dds_entity_t subscribe(dds_entity_t participant,
                              const dds_topic_descriptor_t* type,
                              const char* name) {
  const dds_data_representation_id_t xcdr1 = DDS_DATA_REPRESENTATION_XCDR1;
  const dds_entity_t topic = dds_create_topic(participant, type, name, NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_INFINITY);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 10);
  dds_qset_durability(qos, DDS_DURABILITY_VOLATILE);
  dds_qset_data_representation(qos, 1, &xcdr1);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  return reader;
}

/* The next sample, or NULL after the time is up. */
static void* take(dds_entity_t participant, dds_entity_t reader) {
  static dds_sample_info_t info;
  static void* sample;
  const dds_entity_t waitset = dds_create_waitset(participant);
  dds_waitset_attach(waitset, dds_create_readcondition(reader, DDS_ANY_STATE), 0);
  for (;;) {
    if (dds_waitset_wait(waitset, NULL, 0, DDS_SECS(10)) <= 0) return NULL;
    sample = NULL;
    if (dds_take(reader, &sample, &info, 1, 1) == 1 && info.valid_data) return sample;
  }
}

static void print_pose(const char* label, const std_msgs_msg_dds__Header_* head, const Pose* pose) {
  printf("%s %s %d.%09u %.3f %.3f %.3f %.3f %.3f %.3f %.3f\n", label, head->frame,
         head->time.seconds, head->time.nanoseconds, pose->at.px, pose->at.py, pose->at.pz,
         pose->heading.qx, pose->heading.qy, pose->heading.qz, pose->heading.qw);
}

int main(void) {
  const dds_entity_t node = dds_create_participant(DDS_DOMAIN_DEFAULT, NULL, NULL);
  const dds_entity_t poses =
      subscribe(node, &geometry_msgs_msg_dds__PoseStamped__desc, "rt/tsg/pose");
  const dds_entity_t odometry = subscribe(node, &nav_msgs_msg_dds__Odometry__desc, "rt/tsg/odom");
  const dds_entity_t transforms = subscribe(node, &tf2_msgs_msg_dds__TFMessage__desc, "rt/tf");

  const geometry_msgs_msg_dds__PoseStamped_* pose = take(node, poses);
  if (pose == NULL) return 1;
  print_pose("pose", &pose->head, &pose->what);

  const nav_msgs_msg_dds__Odometry_* odom = take(node, odometry);
  if (odom == NULL) return 1;
  print_pose("odom", &odom->head, &odom->where.mean);
  printf("child %s covariance %.3f %.3f twist %.3f %.3f %.3f\n", odom->child, odom->where.spread[7],
         odom->how_fast.spread[35], odom->how_fast.mean.speed.vx, odom->how_fast.mean.speed.vz,
         odom->how_fast.mean.turn_rate.vz);

  const tf2_msgs_msg_dds__TFMessage_* tf = take(node, transforms);
  if (tf == NULL) return 1;
  for (uint32_t i = 0; i < tf->list._length; ++i) {
    const geometry_msgs_msg_dds__TransformStamped_* link = &tf->list._buffer[i];
    printf("tf %s->%s %.3f %.3f %.3f turn %.3f %.3f\n", link->head.frame, link->child,
           link->what.shift.vx, link->what.shift.vy, link->what.shift.vz, link->what.turn.qy,
           link->what.turn.qw);
  }
  return dds_delete(node) == DDS_RETCODE_OK ? 0 : 1;
}
