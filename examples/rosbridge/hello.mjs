// SPDX-License-Identifier: MIT
// A ROS client: robot A drives ahead and calls, robot B tells what it hears. Time goes on by steps.
//     rovernet live examples/player/player.toml --rosbridge
//     npm install roslib && node hello.mjs
import {Ros, Service, Topic} from "roslib";

const ros = new Ros({url: process.argv[2] ?? "ws://127.0.0.1:9090"});
const topic = (name, messageType) => new Topic({ros, name, messageType});
const call = (name, request) => new Promise((done, fail) =>
  new Service({ros, name, serviceType: ""}).callService(request, done, fail));

topic("/B/radio/received", "rovernet_msgs/Received").subscribe(({src_address, data, rssi}) =>
  console.log(`B hears "${atob(data)}" from ${src_address} at ${rssi.toFixed(1)} dBm`));

let place;
topic("/A/odom", "nav_msgs/Odometry").subscribe(({pose}) => { place = pose.pose.position; });

await call("/simulation/pause", {});
topic("/A/cmd_vel", "geometry_msgs/Twist").publish({linear: {x: 0.5, y: 0, z: 0}, angular: {x: 0, y: 0, z: 0}});
for (let second = 1; second <= 3; ++second) {
  await call("/A/radio/send", {dst_address: "*", data: btoa("hello " + second)});
  await call("/simulation/step", {seconds: 1});
  console.log(`A is at (${place.x.toFixed(1)}, ${place.y.toFixed(1)}) m`);
}
await call("/simulation/unpause", {});
ros.close();
