/* SPDX-License-Identifier: MIT */
/* Declarations of libplayerc that examples/player/wander.c uses, with the types that libplayerc 2.1
 * to 3.1 give them: the example is compiled where that library is not installed. */
#pragma once

#include <stdint.h>

#define PLAYERC_DATAMODE_PULL 2
#define PLAYERC_OPEN_MODE 1

typedef struct playerc_client playerc_client_t;
typedef struct playerc_mclient playerc_mclient_t;

typedef struct {
    double px, py, pa;
    double vx, vy, va;
    int stall;
} playerc_position2d_t;

typedef struct {
    int scan_count;
    double max_range;
    double* ranges;
} playerc_laser_t;

typedef struct {
    uint8_t mac[32];
    uint8_t ip[32];
    uint8_t essid[32];
    int mode;
    int encrypt;
    double freq;
    int qual, level, noise;
} playerc_wifi_link_t;

typedef struct {
    playerc_wifi_link_t* links;
    int link_count;
    char ip[32];
} playerc_wifi_t;

const char* playerc_error_str(void);
playerc_client_t* playerc_client_create(playerc_mclient_t*, const char* host, int port);
void playerc_client_destroy(playerc_client_t*);
int playerc_client_connect(playerc_client_t*);
int playerc_client_disconnect(playerc_client_t*);
int playerc_client_datamode(playerc_client_t*, uint8_t mode);
void* playerc_client_read(playerc_client_t*);

playerc_position2d_t* playerc_position2d_create(playerc_client_t*, int index);
int playerc_position2d_subscribe(playerc_position2d_t*, int access);
int playerc_position2d_unsubscribe(playerc_position2d_t*);
int playerc_position2d_set_cmd_vel(playerc_position2d_t*, double vx, double vy, double va,
                                   int state);

playerc_laser_t* playerc_laser_create(playerc_client_t*, int index);
int playerc_laser_subscribe(playerc_laser_t*, int access);
int playerc_laser_unsubscribe(playerc_laser_t*);

playerc_wifi_t* playerc_wifi_create(playerc_client_t*, int index);
int playerc_wifi_subscribe(playerc_wifi_t*, int access);
int playerc_wifi_unsubscribe(playerc_wifi_t*);
