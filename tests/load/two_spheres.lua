-- wrk's requests: two spheres at 64 x 48, the same each time or (PICTURES=distinct) never twice in
-- runs that differ in ROUND, a number.
local distinct = os.getenv("PICTURES") == "distinct"
local scene = [[{"camera": {"origin": [0, 1, -6], "look_at": [0, 0, 0], "fov": 0.8, "width": 64, "height": 48},
"background": [0.5, 0.8, 0.9], "lights": [{"type": "distant", "direction": [-1, -2, 1]}],
"objects": [{"type": "sphere", "center": [0, 0, %s], "radius": 1, "material": {"color": "#e03020"}},
{"type": "sphere", "center": [1.5, 0.5, -1], "radius": 0.5, "material": {"color": "#20e030"}}]}]]

wrk.method = "POST"
wrk.headers["Content-Type"] = "application/json"
wrk.body = scene:format("0")

if distinct then
  local count = 0
  local round = os.getenv("ROUND") or "0"
  -- One thread only: several would ask for the same numbers.
  request = function()
    count = count + 1
    return wrk.format(nil, nil, nil, scene:format(string.format("0.%03d%07d", round, count)))
  end
end
