// SPDX-License-Identifier: MIT
// A Player client: robot A wanders through an office, turns at walls, and tells whom its radio
// hears.
//
//     cc wander.c -o wander $(pkg-config --cflags --libs playerc)
//     rovernet live player.toml --player &
//     ./wander
#include <libplayerc/playerc.h>
#include <stdio.h>

static int fail(const char* what) {
    fprintf(stderr, "%s: %s\n", what, playerc_error_str());
    return 1;
}

// Distance to the nearest thing ahead [m].
static double way_ahead(const playerc_laser_t* laser) {
    double nearest = laser->max_range;
    for (int i = laser->scan_count / 3; i < 2 * laser->scan_count / 3; ++i) {
        if (laser->ranges[i] < nearest) nearest = laser->ranges[i];
    }
    return nearest;
}

int main(void) {
    playerc_client_t* client = playerc_client_create(NULL, "localhost", 6665);
    if (playerc_client_connect(client) != 0) return fail("connect");
    playerc_client_datamode(client, PLAYERC_DATAMODE_PULL);

    playerc_position2d_t* position = playerc_position2d_create(client, 0);
    playerc_laser_t* laser = playerc_laser_create(client, 0);
    playerc_wifi_t* wifi = playerc_wifi_create(client, 0);
    if (playerc_position2d_subscribe(position, PLAYERC_OPEN_MODE) != 0) return fail("position2d");
    if (playerc_laser_subscribe(laser, PLAYERC_OPEN_MODE) != 0) return fail("laser");
    if (playerc_wifi_subscribe(wifi, PLAYERC_OPEN_MODE) != 0) return fail("wifi");

    for (int step = 0; step < 300 && playerc_client_read(client) != NULL; ++step) {
        const int is_free = way_ahead(laser) > 0.8;
        playerc_position2d_set_cmd_vel(position, is_free ? 0.5 : 0, 0, is_free ? 0 : 0.7, 1);
        if (step % 50 != 0) continue;
        printf("(%.2f, %.2f) m%s\n", position->px, position->py, position->stall ? ", stalled" : "");
        for (int i = 0; i < wifi->link_count; ++i) {
            printf("  hears %.32s at %d dBm\n", (const char*)wifi->links[i].ip,
                   wifi->links[i].level);
        }
    }
    playerc_position2d_set_cmd_vel(position, 0, 0, 0, 1);
    playerc_wifi_unsubscribe(wifi);
    playerc_laser_unsubscribe(laser);
    playerc_position2d_unsubscribe(position);
    playerc_client_disconnect(client);
    playerc_client_destroy(client);
    return 0;
}
