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
  -- All but the number is made once, as wrk does where requests are equal: what it computes is
  -- taken from the server, which is on the same processors.
  local before, after
  init = function()
    local number = string.format("0.%03d", os.getenv("ROUND") or "0")
    local whole = wrk.format(nil, nil, nil, scene:format(number .. "0000000"))
    local begin = whole:find(number .. "0000000", 1, true) + #number
    before, after = whole:sub(1, begin - 1), whole:sub(begin + 7)
  end
  local count = 0
  -- One thread only: several would ask for the same numbers.
  request = function()
    count = count + 1
    return before .. string.format("%07d", count) .. after
  end
end
