% Octave's ode45 on the modal plant, one run; prints one JSON line, cpu_s is the integration alone.
% The linear part is one matrix. State: modal displacements, modal velocities, the voltage (V), the energy in the resistor (J).
% Usage: octave-cli ode45_peer.m PLANT RELATIVE ABSOLUTE
1;

function plant = read_plant (path)
  plant = struct ();
  for line = strsplit (strtrim (fileread (path)), "\n")
    words = strsplit (strtrim (line{1}), " ");
    plant.(words{1}) = str2double (words(2:end))(:);
  end
end

function f = rate_of (plant)
  n = plant.modes;
  omega = 2 * pi * plant.frequency_hz;
  a = zeros (2 * n + 2);
  a(1:n, n + 1:2 * n) = eye (n);
  a(n + 1:2 * n, 1:n) = -diag (omega .^ 2);
  a(n + 1:2 * n, n + 1:2 * n) = -diag (2 * plant.damping_ratio .* omega);
  a(n + 1:2 * n, 2 * n + 1) = plant.coupling_n_per_v;
  a(2 * n + 1, n + 1:2 * n) = -plant.coupling_n_per_v' / plant.capacitance_f;
  a(2 * n + 1, 2 * n + 1) = -1 / (plant.resistance_ohm * plant.capacitance_f);
  drive = [zeros(n, 1); plant.table * plant.amplitude_n; 0; 0];
  push = [zeros(n, 1); -plant.contact_n_per_m15 * plant.tip; 0; 0];
  heat = [zeros(2 * n + 1, 1); 1 / plant.resistance_ohm];
  b = [a, drive, push, heat];
  tip = [plant.tip', zeros(1, n + 2)];
  gap = plant.gap_m;
  shaker = 2 * pi * plant.frequency_drive_hz;
  volt = 2 * n + 1;
  % One expression: calls and branches cost the interpreter more than arithmetic.
  f = @(t, y) b * [y; sin(shaker * t); max(0, tip * y - gap) ^ 1.5; y(volt) ^ 2];
end

words = argv ();
plant = read_plant (words{1});
options = odeset ("RelTol", str2double (words{2}), "AbsTol", str2double (words{3}));
middle = plant.duration_s - plant.average_over_s;
f = rate_of (plant);
start = cputime ();
% Three output times: ode45 then keeps those states only.
[~, y] = ode45 (f, [0, middle / 2, middle], zeros (2 * plant.modes + 2, 1), options);
y = y(end, :)';
y(end) = 0;
[~, y] = ode45 (f, [middle, middle + plant.average_over_s / 2, plant.duration_s], y, options);
taken = cputime () - start;
printf ("{\"mean_power_w\": %.17g, \"cpu_s\": %.9g}\n", y(end, end) / plant.average_over_s, taken);
