// A team of lanes shares a range of items (pixels or light paths): a lane that has finished an item takes the team's
// next one, so that all lanes stay busy.
struct Team {
    uint progress;  // index of its record
    uint begin;     // first item
    uint items;     // 0: there is no work for the team
};

// `share`: items of a team; `total`: items of the dispatch; `firstTeam`: index of the first team's record.
Team teamOfLane(uint share, uint total, uint firstTeam) {
    uint team = gl_GlobalInvocationID.x / kTeamSize;
    uint begin = team * share;
    return Team(firstTeam + team, begin, begin < total ? min(share, total - begin) : 0u);
}

// The number of an item within the team. A result >= team.items means that no items remain.
uint takeItem(Team team) { return atomicAdd(teams[team.progress].taken, 1u); }
void finishItem(Team team) { atomicAdd(teams[team.progress].finished, 1u); }

// The item with this number, or the last one.
uint itemOf(Team team, uint taken) { return team.begin + min(taken, team.items - 1u); }
