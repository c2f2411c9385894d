# Which members are run when. The only place to change.
#
#   splashdown_ensemble(CLASS CI SEEDS NIGHTLY SEEDS BUDGET SECONDS [AS NAME SET KEY=VALUE...])
#
# SEEDS: FROM:TO, or lists like 1:4,9. CI: the fast subset, members that hold; all classes together stay below five
# minutes on two cores. A class without it has no member that holds yet. NIGHTLY: members of the table in
# docs/stability.md, the fallen ones included. BUDGET: wall seconds of a run. AS, SET: the class with other values.
splashdown_ensemble(round_drops CI 31:36 NIGHTLY 1:180 BUDGET 600)
splashdown_ensemble(round_drops_3d CI 7,9 NIGHTLY 1:12 BUDGET 900)
splashdown_ensemble(light_solids CI 5,12,16,32:34,36:39,42,44,45,203,242,249,418 NIGHTLY 1:500 BUDGET 300)
splashdown_ensemble(light_hulls CI 2,3,7,8,14,16,17,22,23,25,36,40,340 NIGHTLY 1:200 BUDGET 300)
splashdown_ensemble(light_polygons CI 2,6,16,18,21,23,27,31:47,60,193,229,246,338,361,388,423,426,456 NIGHTLY 1:1000 BUDGET 300)
splashdown_ensemble(light_polygons AS rubbing_polygons SET contact.friction=0.5
                    CI 1,20,27,28,60,89,105,140,220 NIGHTLY 1:250 BUDGET 300)
splashdown_ensemble(drops_and_jets CI 1:8,13,14,17,18,21:23,25,28:33,36,41,42,45:48,51,56,533,675,752,753 NIGHTLY 1:900 BUDGET 300)
splashdown_ensemble(still_tanks NIGHTLY 1:20 BUDGET 900)
splashdown_ensemble(slots CI 1:10,18,20,24,74,84,2006,2017,2057,2086,2097,2111,4053 NIGHTLY 1:219,2001:2150,4053 BUDGET 300)
splashdown_ensemble(uav_attitudes NIGHTLY 0:15 BUDGET 900)
splashdown_ensemble(effect_mixes CI 1:4,14,23,24,29,85,94,170 NIGHTLY 1:200 BUDGET 300)

# The same laws for the monolithic formulation: the second table of docs/stability.md.
set(monolithic SET fluid.formulation=monolithic)
splashdown_ensemble(drops_and_jets AS monolithic_drops ${monolithic} CI 1:3,5:10 NIGHTLY 1:60 BUDGET 300)
splashdown_ensemble(slots AS monolithic_slots ${monolithic} CI 1:5,7:10 NIGHTLY 1:24 BUDGET 300)
splashdown_ensemble(light_polygons AS monolithic_polygons ${monolithic} CI 2,5,8,11,16,30,42 NIGHTLY 1:50 BUDGET 300)
splashdown_ensemble(round_drops AS monolithic_round_drops ${monolithic} CI 36 NIGHTLY 31:36 BUDGET 600)
