(* Growth vectors by explicit Lie brackets: distributions whose coefficients are polynomials in the coordinates, their
   sines and cosines. A bracket is computed inside the kernel; `bracket_is` says that it is one. *)

Require Export Reals QArith Qreals List.
Require Import Lra Lia ZArith Ratan.
Export ListNotations.
Open Scope R_scope.

(* A configuration gives every coordinate a number; a vector gives one to every place. *)
Notation vector := (nat -> R).

(* ---- polynomials in q_i, sin q_i, cos q_i ---- *)

(* Powers of q_i, sin q_i, cos q_i, a triple a coordinate. *)
Notation monomial := (list (nat * nat * nat)).
Notation polynomial := (list (monomial * Q)).

Definition power_of (x : R) (t : nat * nat * nat) : R :=
  match t with (a, b, c) => x ^ a * sin x ^ b * cos x ^ c end.

Fixpoint monomial_value (q : vector) (i : nat) (m : monomial) : R :=
  match m with [] => 1 | t :: m' => power_of (q i) t * monomial_value q (S i) m' end.

Fixpoint value_from (q : vector) (i : nat) (p : polynomial) : R :=
  match p with [] => 0 | (m, v) :: p' => Q2R v * monomial_value q i m + value_from q i p' end.

Definition value (q : vector) (p : polynomial) : R := value_from q 0 p.

Definition compare_triples (s t : nat * nat * nat) : comparison :=
  match s, t with (a, b, c), (a', b', c') =>
    match Nat.compare a a' with
    | Eq => match Nat.compare b b' with Eq => Nat.compare c c' | other => other end
    | other => other
    end
  end.

Fixpoint compare_monomials (m n : monomial) : comparison :=
  match m, n with
  | [], [] => Eq
  | [], _ => Lt
  | _, [] => Gt
  | s :: m', t :: n' => match compare_triples s t with Eq => compare_monomials m' n' | other => other end
  end.

Fixpoint plus (p : polynomial) : polynomial -> polynomial :=
  fix with_p (r : polynomial) : polynomial :=
    match p, r with
    | [], _ => r
    | _, [] => p
    | (m, v) :: p', (n, w) :: r' =>
        match compare_monomials m n with
        | Eq => let u := Qred (v + w) in if Qeq_bool u 0 then plus p' r' else (m, u) :: plus p' r'
        | Lt => (m, v) :: plus p' r
        | Gt => (n, w) :: with_p r'
        end
    end.

Fixpoint joined (m n : monomial) : monomial :=
  match m, n with
  | [], _ => n
  | _, [] => m
  | (a, b, c) :: m', (a', b', c') :: n' => (a + a', b + b', c + c')%nat :: joined m' n'
  end.

Definition scaled (m : monomial) (v : Q) (p : polynomial) : polynomial :=
  map (fun t => (joined m (fst t), Qred (v * snd t))) p.

Fixpoint term_by_term (p r : polynomial) : polynomial :=
  match p with [] => [] | (m, v) :: p' => plus (scaled m v r) (term_by_term p' r) end.

(* Sums are as long as the longer factor: the shorter one is gone through. *)
Definition times (p r : polynomial) : polynomial :=
  if Nat.leb (length p) (length r) then term_by_term p r else term_by_term r p.

Definition number (v : Q) : polynomial := if Qeq_bool v 0 then [] else [([], v)].
Definition opposite_of (p : polynomial) : polynomial := scaled [] (-1) p.
Fixpoint at_place (i : nat) (t : nat * nat * nat) : monomial :=
  match i with O => [t] | S j => (0, 0, 0)%nat :: at_place j t end.
Definition coordinate (i : nat) : polynomial := [(at_place i (1, 0, 0)%nat, 1%Q)].
Definition sine (i : nat) : polynomial := [(at_place i (0, 1, 0)%nat, 1%Q)].
Definition cosine (i : nat) : polynomial := [(at_place i (0, 0, 1)%nat, 1%Q)].
Fixpoint raised (p : polynomial) (n : nat) : polynomial :=
  match n with O => number 1 | S k => times p (raised p k) end.

Declare Scope polynomial_scope.
Delimit Scope polynomial_scope with polynomial.
Notation "p + r" := (plus p r) : polynomial_scope.
Notation "p * r" := (times p r) : polynomial_scope.
Notation "p - r" := (plus p (opposite_of r)) : polynomial_scope.
Notation "- p" := (opposite_of p) : polynomial_scope.
Notation "p ^ n" := (raised p n) : polynomial_scope.

Fixpoint pairwise (ps : list polynomial) : list polynomial :=
  match ps with p :: r :: rest => plus p r :: pairwise rest | _ => ps end.

Fixpoint sum_in (rounds : nat) (ps : list polynomial) : polynomial :=
  match rounds, ps with
  | _, [] => []
  | _, [p] => p
  | O, _ => fold_right plus [] ps
  | S k, _ => sum_in k (pairwise ps)
  end.
Definition sum_of (ps : list polynomial) : polynomial := sum_in 40 ps.

(* No sine stands squared: sin^2 is written as 1 - cos^2. *)
Fixpoint reduced_triple (a b c : nat) : list ((nat * nat * nat) * Q) :=
  match b with
  | S (S b') => reduced_triple a b' c ++ map (fun t => (fst t, Qopp (snd t))) (reduced_triple a b' (S (S c)))
  | _ => [((a, b, c), 1%Q)]
  end.

(* A triple before others; zeros at the end are not written. *)
Definition before (t : nat * nat * nat) (m : monomial) : monomial :=
  match m, t with [], (O, O, O) => [] | _, _ => t :: m end.

Fixpoint reduced_monomial (m : monomial) : list (monomial * Q) :=
  match m with
  | [] => [([], 1%Q)]
  | (a, b, c) :: m' =>
      flat_map (fun t => map (fun u => (before (fst t) (fst u), snd t * snd u)%Q) (reduced_monomial m')) (reduced_triple a b c)
  end.

Definition reduced (p : polynomial) : polynomial :=
  sum_of (flat_map (fun t => map (fun u => [(fst u, Qred (snd t * snd u))]) (reduced_monomial (fst t))) p).

(* ---- derivatives ---- *)

Definition derived_triple (t : nat * nat * nat) : list ((nat * nat * nat) * Q) :=
  match t with (a, b, c) =>
    (match a with O => [] | S a' => [((a', b, c), inject_Z (Z.of_nat a))] end) ++
    (match b with O => [] | S b' => [((a, b', S c), inject_Z (Z.of_nat b))] end) ++
    (match c with O => [] | S c' => [((a, S b, c'), inject_Z (- Z.of_nat c))] end)
  end.

Fixpoint derived_monomial (k : nat) (m : monomial) {struct m} : list (monomial * Q) :=
  match m, k with
  | [], _ => []
  | t :: m', O => map (fun u => (fst u :: m', snd u)) (derived_triple t)
  | t :: m', S k' => map (fun u => (t :: fst u, snd u)) (derived_monomial k' m')
  end.

(* The derivative by the coordinate k. *)
Definition derived (k : nat) (p : polynomial) : polynomial :=
  reduced (sum_of (flat_map (fun t => map (fun u => [(fst u, Qred (snd t * snd u))]) (derived_monomial k (fst t))) p)).

(* ---- what these computations mean ---- *)

Lemma value_plus : forall q i p r, value_from q i (plus p r) = value_from q i p + value_from q i r.
Proof.
  intros q i p. induction p as [| [m v] p' IHp].
  - destruct r; simpl; ring.
  - induction r as [| [n w] r' IHr]; [simpl; ring |].
    assert (unfolded : plus ((m, v) :: p') ((n, w) :: r') =
      match compare_monomials m n with
      | Eq => let u := Qred (v + w) in if Qeq_bool u 0 then plus p' r' else (m, u) :: plus p' r'
      | Lt => (m, v) :: plus p' ((n, w) :: r')
      | Gt => (n, w) :: plus ((m, v) :: p') r'
      end) by reflexivity.
    rewrite unfolded. clear unfolded.
    destruct (compare_monomials m n) eqn:order.
    + assert (same : m = n).
      { clear - order. revert n order. induction m as [| [[a b] c] m' IH]; destruct n as [| [[a' b'] c'] n']; simpl; try discriminate; auto.
        unfold compare_triples. destruct (Nat.compare a a') eqn:A; try discriminate.
        destruct (Nat.compare b b') eqn:B; try discriminate. destruct (Nat.compare c c') eqn:C; try discriminate.
        apply Nat.compare_eq in A, B, C. intro rest. apply IH in rest. subst. reflexivity. }
      subst n.
      assert (sum : Q2R (Qred (v + w)) = Q2R v + Q2R w).
      { rewrite <- Q2R_plus. apply Qeq_eqR, Qred_correct. }
      cbv zeta. destruct (Qeq_bool (Qred (v + w)) 0) eqn:zero.
      * apply Qeq_bool_eq in zero. apply Qeq_eqR in zero. rewrite sum in zero.
        rewrite IHp. simpl. unfold Q2R in zero at 3. simpl in zero.
        replace (Q2R w) with (- Q2R v) by lra. ring.
      * cbn [value_from]. rewrite sum, IHp. ring.
    + cbn [value_from]. rewrite IHp. cbn [value_from]. ring.
    + cbn [value_from]. rewrite IHr. cbn [value_from]. ring.
Qed.

Lemma power_joined : forall x a b c a' b' c',
  power_of x (a + a', b + b', c + c')%nat = power_of x (a, b, c) * power_of x (a', b', c').
Proof. intros. unfold power_of. rewrite !pow_add. ring. Qed.

Lemma monomial_joined : forall q m n i, monomial_value q i (joined m n) = monomial_value q i m * monomial_value q i n.
Proof.
  intro q. induction m as [| [[a b] c] m' IH]; intros n i; [simpl; ring |].
  destruct n as [| [[a' b'] c'] n']; [simpl; ring |].
  cbn [joined monomial_value]. rewrite IH, power_joined. ring.
Qed.

Lemma Q2R_red : forall v, Q2R (Qred v) = Q2R v.
Proof. intro v. apply Qeq_eqR, Qred_correct. Qed.

Lemma value_scaled : forall q i m v p, value_from q i (scaled m v p) = Q2R v * monomial_value q i m * value_from q i p.
Proof.
  intros. induction p as [| [n w] p' IH]; [simpl; ring |].
  unfold scaled in *. cbn [map value_from fst snd]. rewrite IH, monomial_joined, Q2R_red, Q2R_mult. ring.
Qed.

Lemma value_term_by_term : forall q i p r, value_from q i (term_by_term p r) = value_from q i p * value_from q i r.
Proof.
  intros. induction p as [| [m v] p' IH]; [simpl; ring |].
  cbn [term_by_term value_from]. rewrite value_plus, value_scaled, IH. ring.
Qed.

Lemma value_times : forall q i p r, value_from q i (times p r) = value_from q i p * value_from q i r.
Proof. intros. unfold times. destruct (Nat.leb _ _); rewrite value_term_by_term; ring. Qed.

Definition total (xs : list R) : R := fold_right Rplus 0 xs.

Lemma value_pairwise_bounded : forall q i n ps, (length ps <= n)%nat ->
  total (map (value_from q i) (pairwise ps)) = total (map (value_from q i) ps).
Proof.
  intros q i. induction n as [| n IH]; intros ps short.
  - destruct ps; [reflexivity | simpl in short; lia].
  - destruct ps as [| p [| r rest]]; try reflexivity.
    cbn [pairwise map total fold_right]. rewrite value_plus. unfold total in IH.
    rewrite IH by (simpl in short; lia). ring.
Qed.

Lemma value_fold : forall q i ps, value_from q i (fold_right plus [] ps) = total (map (value_from q i) ps).
Proof. intros. induction ps as [| p rest IH]; [reflexivity |]. simpl. rewrite value_plus, IH. reflexivity. Qed.

Lemma value_sum_in : forall q i k ps, value_from q i (sum_in k ps) = total (map (value_from q i) ps).
Proof.
  intros q i. induction k as [| k IH]; intro ps.
  - destruct ps as [| p [| r rest]]; [reflexivity | simpl; ring |]. apply value_fold.
  - destruct ps as [| p [| r rest]]; [reflexivity | simpl; ring |].
    cbn [sum_in]. rewrite IH. apply (value_pairwise_bounded q i (length (p :: r :: rest))). lia.
Qed.

Lemma value_sum : forall q i ps, value_from q i (sum_of ps) = total (map (value_from q i) ps).
Proof. intros. apply value_sum_in. Qed.

(* Sums of single terms, each from a term of a polynomial. *)
Lemma total_app : forall xs ys, total (xs ++ ys) = total xs + total ys.
Proof. induction xs as [| x xs IH]; intro ys; simpl; [ring |]. rewrite IH. unfold total. ring. Qed.

Lemma value_terms : forall q i (f : monomial -> list (monomial * Q)) (g : monomial -> R) p,
  (forall m, total (map (fun u => Q2R (snd u) * monomial_value q i (fst u)) (f m)) = g m) ->
  value_from q i (sum_of (flat_map (fun t => map (fun u => [(fst u, Qred (snd t * snd u))]) (f (fst t))) p))
  = total (map (fun t => Q2R (snd t) * g (fst t)) p).
Proof.
  intros q i f g p is. rewrite value_sum.
  set (F := fun t : monomial * Q => map (fun u => [(fst u, Qred (snd t * snd u))]) (f (fst t))).
  induction p as [| [m v] p' IH]; [reflexivity |].
  change (flat_map F ((m, v) :: p')) with (F (m, v) ++ flat_map F p').
  rewrite map_app, total_app. etransitivity; [apply Rplus_eq_compat_l; exact IH |]. cbn [map total fold_right fst snd]. fold (total (map (fun t => Q2R (snd t) * g (fst t)) p')).
  f_equal. rewrite <- (is m). unfold F. cbn [fst snd]. clear.
  induction (f m) as [| [n w] rest IH]; [simpl; ring |].
  cbn [map fst snd value_from total fold_right] in *. unfold total in *. rewrite IH, Q2R_red, Q2R_mult. ring.
Qed.

Lemma value_as_total : forall q i p, value_from q i p = total (map (fun t => Q2R (snd t) * monomial_value q i (fst t)) p).
Proof. intros. induction p as [| [m v] p' IH]; [reflexivity |]. cbn [value_from]. rewrite IH. reflexivity. Qed.

Lemma square_of_sine : forall x, sin x * sin x = 1 - cos x * cos x.
Proof. intro x. pose proof (sin2_cos2 x) as H. unfold Rsqr in H. lra. Qed.

Lemma total_opposite : forall (A : Type) (f : A -> Q) (g : A -> R) xs,
  total (map (fun t => Q2R (Qopp (f t)) * g t) xs) = - total (map (fun t => Q2R (f t) * g t) xs).
Proof.
  intros. induction xs as [| x xs IH]; [simpl; ring |].
  unfold total in *. cbn [map fold_right]. rewrite IH, Q2R_opp. ring.
Qed.

Lemma reduced_triple_is : forall x n a b c, (b <= n)%nat ->
  total (map (fun t => Q2R (snd t) * power_of x (fst t)) (reduced_triple a b c)) = power_of x (a, b, c).
Proof.
  intro x. induction n as [| n IH]; intros a b c small.
  - destruct b; [| lia]. simpl. unfold Q2R; simpl. field.
  - destruct b as [| [| b']]; try (simpl; unfold Q2R; simpl; field).
    cbn [reduced_triple]. rewrite map_app, total_app, map_map. cbn [fst snd].
    rewrite (total_opposite _ (fun t => snd t) (fun t => power_of x (fst t))).
    rewrite !IH by lia. unfold power_of. cbn [pow].
    replace (x ^ a * (sin x * (sin x * sin x ^ b')) * cos x ^ c) with (x ^ a * (sin x * sin x) * sin x ^ b' * cos x ^ c) by ring.
    rewrite square_of_sine. ring.
Qed.

Lemma before_is : forall q i t m, monomial_value q i (before t m) = power_of (q i) t * monomial_value q (S i) m.
Proof. intros q i [[a b] c] m. destruct m; [| reflexivity]. destruct a, b, c; simpl; ring. Qed.

Lemma reduced_monomial_is : forall q m i,
  total (map (fun u => Q2R (snd u) * monomial_value q i (fst u)) (reduced_monomial m)) = monomial_value q i m.
Proof.
  intro q. induction m as [| [[a b] c] m' IH]; intro i.
  - simpl. unfold Q2R; simpl. field.
  - cbn [reduced_monomial monomial_value].
    rewrite <- (reduced_triple_is (q i) b a b c) by lia.
    induction (reduced_triple a b c) as [| [t v] rest more]; [simpl; ring |].
    cbn [flat_map map]. rewrite map_app, total_app, more, map_map. cbn [fst snd total fold_right].
    rewrite Rmult_plus_distr_r. f_equal. rewrite <- (IH (S i)). clear.
    induction (reduced_monomial m') as [| [n w] rest IH]; [simpl; ring |].
    cbn [map fst snd total fold_right] in *. unfold total in *. rewrite IH, Q2R_mult, before_is. ring.
Qed.

Lemma value_reduced : forall q i p, value_from q i (reduced p) = value_from q i p.
Proof.
  intros. unfold reduced. rewrite (value_terms q i reduced_monomial (monomial_value q i)).
  - rewrite value_as_total. reflexivity.
  - intro m. apply reduced_monomial_is.
Qed.

(* The configuration with another value of the coordinate k. *)
Definition moved (q : vector) (k : nat) (x : R) : vector := fun i => if Nat.eqb i k then x else q i.

Lemma moved_here : forall q k x, moved q k x k = x.
Proof. intros. unfold moved. rewrite Nat.eqb_refl. reflexivity. Qed.

Lemma moved_elsewhere : forall q k x i, i <> k -> moved q k x i = q i.
Proof. intros q k x i other. unfold moved. apply Nat.eqb_neq in other. rewrite other. reflexivity. Qed.

Lemma rest_unmoved : forall q k x m i, (k < i)%nat -> monomial_value (moved q k x) i m = monomial_value q i m.
Proof.
  intros q k x. induction m as [| t m' IH]; intros i above; [reflexivity |].
  cbn [monomial_value]. rewrite IH, moved_elsewhere by lia. reflexivity.
Qed.

Lemma same_derivative : forall (f g : R -> R) x d, (forall y, f y = g y) -> derivable_pt_lim f x d -> derivable_pt_lim g x d.
Proof. intros f g x d same is e positive. destruct (is e positive) as [near H]. exists near. intros. rewrite <- !same. auto. Qed.

Lemma derivative_of_constant : forall c x, derivable_pt_lim (fun _ => c) x 0.
Proof. exact derivable_pt_lim_const. Qed.

Lemma derivative_of_power : forall (f : R -> R) x d n, derivable_pt_lim f x d ->
  derivable_pt_lim (fun y => f y ^ n) x (INR n * f x ^ pred n * d).
Proof.
  intros f x d n is. apply (derivable_pt_lim_comp f (fun z => z ^ n) x d (INR n * f x ^ pred n) is).
  apply derivable_pt_lim_pow.
Qed.

Lemma Q2R_count : forall n, Q2R (inject_Z (Z.of_nat n)) = INR n.
Proof. intro n. unfold Q2R, inject_Z. simpl. rewrite INR_IZR_INZ. field. Qed.

Lemma Q2R_less : forall n, Q2R (inject_Z (- Z.of_nat n)) = - INR n.
Proof. intro n. unfold Q2R, inject_Z. simpl. rewrite opp_IZR, INR_IZR_INZ. field. Qed.

Lemma derived_triple_is : forall x t,
  derivable_pt_lim (fun y => power_of y t) x (total (map (fun u => Q2R (snd u) * power_of x (fst u)) (derived_triple t))).
Proof.
  intros x [[a b] c].
  assert (by_products : derivable_pt_lim (fun y => power_of y (a, b, c)) x
    ((INR a * x ^ pred a * 1 * sin x ^ b + x ^ a * (INR b * sin x ^ pred b * cos x)) * cos x ^ c
     + x ^ a * sin x ^ b * (INR c * cos x ^ pred c * - sin x))).
  { apply (derivable_pt_lim_mult (fun y => y ^ a * sin y ^ b) (fun y => cos y ^ c)).
    - apply (derivable_pt_lim_mult (fun y => y ^ a) (fun y => sin y ^ b)).
      + apply (derivative_of_power (fun y => y)). apply derivable_pt_lim_id.
      + apply derivative_of_power. apply derivable_pt_lim_sin.
    - apply derivative_of_power. apply derivable_pt_lim_cos. }
  replace (total (map (fun u => Q2R (snd u) * power_of x (fst u)) (derived_triple (a, b, c)))) with
    ((INR a * x ^ pred a * 1 * sin x ^ b + x ^ a * (INR b * sin x ^ pred b * cos x)) * cos x ^ c
     + x ^ a * sin x ^ b * (INR c * cos x ^ pred c * - sin x)); [exact by_products |].
  unfold derived_triple. rewrite !map_app, !total_app.
  destruct a, b, c; cbn [map total fold_right fst snd pred]; rewrite ?Q2R_count, ?Q2R_less; unfold power_of;
    cbn [pow]; try (change (INR 0) with 0); ring.
Qed.

Lemma derived_monomial_is : forall q m i k,
  derivable_pt_lim (fun x => monomial_value (moved q (i + k) x) i m) (q (i + k)%nat)
    (total (map (fun u => Q2R (snd u) * monomial_value q i (fst u)) (derived_monomial k m))).
Proof.
  intro q. induction m as [| t m' IH]; intros i k.
  - exact (derivative_of_constant 1 _).
  - destruct k as [| k'].
    + rewrite Nat.add_0_r.
      replace (total (map (fun u => Q2R (snd u) * monomial_value q i (fst u)) (derived_monomial 0 (t :: m')))) with
        (total (map (fun u => Q2R (snd u) * power_of (q i) (fst u)) (derived_triple t)) * monomial_value q (S i) m'
         + power_of (q i) t * 0).
      * apply (same_derivative (fun x => power_of x t * monomial_value q (S i) m')).
        { intro x. cbn [monomial_value]. rewrite moved_here, rest_unmoved by lia. reflexivity. }
        apply (derivable_pt_lim_mult (fun x => power_of x t) (fun _ => monomial_value q (S i) m')).
        -- apply derived_triple_is.
        -- apply derivative_of_constant.
      * cbn [derived_monomial]. rewrite map_map. cbn [fst snd]. rewrite Rmult_0_r, Rplus_0_r.
        induction (derived_triple t) as [| [u v] rest more]; [simpl; ring |].
        cbn [map total fold_right fst snd monomial_value] in *. unfold total in *. rewrite <- more. ring.
    + replace (i + S k')%nat with (S i + k')%nat by lia.
      replace (total (map (fun u => Q2R (snd u) * monomial_value q i (fst u)) (derived_monomial (S k') (t :: m')))) with
        (0 * monomial_value q (S i) m'
         + power_of (q i) t * total (map (fun u => Q2R (snd u) * monomial_value q (S i) (fst u)) (derived_monomial k' m'))).
      * apply (same_derivative (fun x => power_of (q i) t * monomial_value (moved q (S i + k') x) (S i) m')).
        { intro x. cbn [monomial_value]. rewrite (moved_elsewhere q (S i + k') x i) by lia. reflexivity. }
        replace (monomial_value q (S i) m') with (monomial_value (moved q (S i + k') (q (S i + k')%nat)) (S i) m').
        { apply (derivable_pt_lim_mult (fun _ => power_of (q i) t) (fun x => monomial_value (moved q (S i + k') x) (S i) m')).
          - apply derivative_of_constant.
          - apply IH. }
        assert (unmoved : forall n j, monomial_value (moved q (S i + k') (q (S i + k')%nat)) j n = monomial_value q j n).
        { induction n as [| u n' same]; intro j; [reflexivity |]. cbn [monomial_value]. rewrite same. f_equal.
          unfold moved. destruct (Nat.eqb j (S i + k')) eqn:e; [| reflexivity].
          apply Nat.eqb_eq in e. rewrite e. reflexivity. }
        apply unmoved.
      * cbn [derived_monomial]. rewrite map_map. cbn [fst snd]. rewrite Rmult_0_l, Rplus_0_l.
        induction (derived_monomial k' m') as [| [n v] rest more]; [simpl; ring |].
        cbn [map total fold_right fst snd monomial_value] in *. unfold total in *. rewrite <- more. ring.
Qed.

(* The derivative is the limit of quotients of differences. *)
Theorem derived_is : forall q k p, derivable_pt_lim (fun x => value (moved q k x) p) (q k) (value q (derived k p)).
Proof.
  intros q k p. unfold value, derived. rewrite value_reduced.
  rewrite (value_terms q 0 (derived_monomial k)
    (fun m => total (map (fun u => Q2R (snd u) * monomial_value q 0 (fst u)) (derived_monomial k m)))) by reflexivity.
  induction p as [| [m v] p' IH].
  - exact (derivative_of_constant 0 _).
  - cbn [value_from map total fold_right fst snd].
    apply (derivable_pt_lim_plus (fun x => Q2R v * monomial_value (moved q k x) 0 m)); [| exact IH].
    apply (derivable_pt_lim_scal (fun x => monomial_value (moved q k x) 0 m)). apply (derived_monomial_is q m 0 k).
Qed.

(* ---- vector fields ---- *)

(* A polynomial a coordinate: a vector field, or a row of coefficients of the rates. *)
Notation field := (list polynomial).
Definition component (X : field) (l : nat) : polynomial := nth l X [].
Definition values (q : vector) (X : field) : vector := fun l => value q (component X l).

Fixpoint sum_below (n : nat) (f : nat -> R) : R := match n with O => 0 | S k => sum_below k f + f k end.

Definition products (n : nat) (A X : field) : polynomial :=
  reduced (sum_of (map (fun k => times (component A k) (component X k)) (seq 0 n))).

(* p times the derivative of r, which is not taken where p is zero. *)
Definition times_derived (p : polynomial) (k : nat) (r : polynomial) : polynomial :=
  match p with [] => [] | _ => times p (derived k r) end.

Definition bracket_component (n : nat) (X Y : field) (l : nat) : polynomial :=
  reduced (plus (sum_of (map (fun k => times_derived (component X k) k (component Y l)) (seq 0 n)))
                (opposite_of (sum_of (map (fun k => times_derived (component Y k) k (component X l)) (seq 0 n))))).
Definition bracket (n : nat) (X Y : field) : field := map (bracket_component n X Y) (seq 0 n).

Lemma total_below : forall f n, total (map f (seq 0 n)) = sum_below n f.
Proof.
  intros f. induction n as [| n IH]; [reflexivity |].
  rewrite seq_S, map_app, total_app, IH. cbn [map total fold_right sum_below Nat.add]. ring.
Qed.

Lemma sum_of_equals : forall n f g, (forall k, (k < n)%nat -> f k = g k) -> sum_below n f = sum_below n g.
Proof. intros n f g. induction n as [| n IH]; intro same; [reflexivity |]. simpl. rewrite IH, same by auto. reflexivity. Qed.

Lemma value_of_sum : forall q f n, value_from q 0 (sum_of (map f (seq 0 n))) = sum_below n (fun k => value_from q 0 (f k)).
Proof. intros. rewrite value_sum, map_map. apply total_below. Qed.

Lemma value_times_derived : forall q i p k r,
  value_from q i (times_derived p k r) = value_from q i p * value_from q i (derived k r).
Proof. intros. unfold times_derived. rewrite <- value_times. destruct p; reflexivity. Qed.

Lemma value_products : forall q n A X, value q (products n A X) = sum_below n (fun k => values q A k * values q X k).
Proof.
  intros. unfold products, values, value. rewrite value_reduced, value_of_sum.
  apply sum_of_equals. intros. apply value_times.
Qed.

Lemma component_map : forall f n l, (l < n)%nat -> component (map f (seq 0 n)) l = f l.
Proof.
  intros. unfold component. rewrite (nth_indep _ [] (f 0%nat)) by (rewrite map_length, seq_length; auto).
  rewrite map_nth, seq_nth by auto. reflexivity.
Qed.

(* The bracket of two fields by the derivatives of their components. *)
Theorem bracket_is : forall n X Y q l, (l < n)%nat -> exists dX dY : nat -> R,
  (forall k, derivable_pt_lim (fun x => values (moved q k x) X l) (q k) (dX k)) /\
  (forall k, derivable_pt_lim (fun x => values (moved q k x) Y l) (q k) (dY k)) /\
  values q (bracket n X Y) l = sum_below n (fun k => values q X k * dY k) - sum_below n (fun k => values q Y k * dX k).
Proof.
  intros n X Y q l inside.
  exists (fun k => value q (derived k (component X l))), (fun k => value q (derived k (component Y l))).
  split; [| split]; try (intro k; apply derived_is).
  unfold values, value, bracket. rewrite component_map by exact inside. unfold bracket_component.
  rewrite value_reduced, value_plus. unfold opposite_of. rewrite value_scaled, !value_of_sum.
  cbn [monomial_value]. replace (Q2R (-1)) with (-1) by (unfold Q2R; simpl; field).
  rewrite (sum_of_equals n (fun k => value_from q 0 (times_derived (component X k) k (component Y l)))
    (fun k => value_from q 0 (component X k) * value_from q 0 (derived k (component Y l)))) by (intros; apply value_times_derived).
  rewrite (sum_of_equals n (fun k => value_from q 0 (times_derived (component Y k) k (component X l)))
    (fun k => value_from q 0 (component Y k) * value_from q 0 (derived k (component X l)))) by (intros; apply value_times_derived).
  ring.
Qed.

(* Brackets of all pairs. *)
Fixpoint of_pairs (n : nat) (fields : list field) : list field :=
  match fields with [] => [] | X :: rest => map (bracket n X) rest ++ of_pairs n rest end.

(* The left-normed brackets that are longer by one: of all fields with those of a level. *)
Definition longer (n : nat) (fields level : list field) (length : nat) : list field :=
  match length with
  | 1%nat => of_pairs n fields
  | _ => flat_map (fun Y => map (fun X => bracket n X Y) fields) level
  end.

Fixpoint brackets (n : nat) (fields : list field) (length : nat) : list field :=
  match length with O => [] | S O => fields | S k => longer n fields (brackets n fields k) k end.

(* All brackets of at most a length. *)
Fixpoint up_to (n : nat) (fields : list field) (length : nat) : list field :=
  match length with O => [] | S k => up_to n fields k ++ brackets n fields (S k) end.

(* ---- dimensions ---- *)

Fixpoint combination (cs : list R) (vs : list vector) : vector :=
  match cs, vs with c :: cs', v :: vs' => fun j => c * v j + combination cs' vs' j | _, _ => fun _ => 0 end.

Definition independent (n : nat) (vs : list vector) : Prop :=
  forall cs, length cs = length vs -> (forall j, (j < n)%nat -> combination cs vs j = 0) -> Forall (eq 0) cs.

Definition spanned (n : nat) (vs : list vector) (v : vector) : Prop :=
  exists cs, length cs = length vs /\ forall j, (j < n)%nat -> combination cs vs j = v j.

(* The span of vectors with n places has dimension d: d of them are independent and the others combinations of these. *)
Definition dimension (n : nat) (vs : list vector) (d : nat) : Prop :=
  exists places, length places = d /\
    independent n (map (fun i => nth i vs (fun _ => 0)) places) /\
    Forall (spanned n (map (fun i => nth i vs (fun _ => 0)) places)) vs.

(* ---- the same of rational vectors, decided ---- *)

Open Scope Q_scope.

Definition real (v : list Q) : vector := fun j => Q2R (nth j v 0).

Fixpoint dot (u v : list Q) : Q := match u, v with x :: u', y :: v' => Qred (x * y + dot u' v') | _, _ => 0 end.

Fixpoint minus_multiple (u : list Q) (c : Q) (v : list Q) : list Q :=
  match u, v with
  | x :: u', y :: v' => (if Qeq_bool y 0 then x else Qred (x - c * y)) :: minus_multiple u' c v'
  | _, [] => u
  | [], _ => []
  end.

Fixpoint first_not_zero (n j : nat) (v : list Q) : option nat :=
  match n, v with
  | S n', x :: v' => if Qeq_bool x 0 then first_not_zero n' (S j) v' else Some j
  | _, _ => None
  end.

(* Rows with ones at their pivots and zeros there in all others. *)
Definition cleared (rows : list (nat * list Q)) (v : list Q) : list Q :=
  fold_left (fun v r => let c := nth (fst r) v 0 in if Qeq_bool c 0 then v else minus_multiple v c (snd r)) rows v.

Definition with_row (n : nat) (rows : list (nat * list Q)) (v : list Q) : option (list (nat * list Q)) :=
  let v := cleared rows v in
  match first_not_zero n 0 v with
  | None => None
  | Some p =>
      let inverse := Qinv (nth p v 0) in
      let v := map (fun x => Qred (inverse * x)) v in
      Some (map (fun r => (fst r, let c := nth p (snd r) 0 in if Qeq_bool c 0 then snd r else minus_multiple (snd r) c v)) rows
            ++ [(p, v)])
  end.

(* Places of vectors that none before them combine to. *)
Fixpoint chosen (n : nat) (i : nat) (rows : list (nat * list Q)) (vs : list (list Q)) : list nat :=
  match vs with
  | [] => []
  | v :: vs' => match with_row n rows v with
                | None => chosen n (S i) rows vs'
                | Some more => i :: chosen n (S i) more vs'
                end
  end.

Definition unit (d i : nat) : list Q := map (fun j => if Nat.eqb i j then 1%Q else 0%Q) (seq 0 d).

(* The columns of L with V L = 1. *)
Definition right_inverse (n : nat) (vs : list (list Q)) : list (list Q) :=
  let d := length vs in
  let rows := fold_left (fun rows iv => match with_row n rows (snd iv ++ unit d (fst iv)) with Some more => more | None => rows end)
    (combine (seq 0 d) vs) [] in
  map (fun c => map (fun j => match find (fun r => Nat.eqb (fst r) j) rows with
                              | Some r => nth (n + c) (snd r) 0%Q
                              | None => 0%Q end) (seq 0 n)) (seq 0 d).

Fixpoint combined (cs : list Q) (vs : list (list Q)) (j : nat) : Q :=
  match cs, vs with c :: cs', v :: vs' => Qred (c * nth j v 0 + combined cs' vs' j) | _, _ => 0 end.

Definition inverts (columns : list (list Q)) (vs : list (list Q)) : bool :=
  forallb (fun i => forallb (fun k => Qeq_bool (dot (nth k columns []) (nth i vs [])) (if Nat.eqb i k then 1 else 0))
    (seq 0 (length columns))) (seq 0 (length vs)).

Definition spans (n : nat) (columns vs : list (list Q)) (v : list Q) : bool :=
  let cs := map (fun c => dot c v) columns in
  forallb (fun j => Qeq_bool (combined cs vs j) (nth j v 0)) (seq 0 n).

Definition has_dimension (n : nat) (vs : list (list Q)) (d : nat) : bool :=
  let places := chosen n 0 [] vs in
  let basis := map (fun i => nth i vs []) places in
  let columns := right_inverse n basis in
  Nat.eqb (length places) d && Nat.eqb (length columns) d
  && forallb (fun c => Nat.leb (length c) n) columns && inverts columns basis && forallb (spans n columns basis) vs.

Open Scope R_scope.

(* sum_j c_j v_j of the first places *)
Lemma dot_below : forall n u v, (length u <= n)%nat -> Q2R (dot u v) = sum_below n (fun j => real u j * real v j).
Proof.
  assert (shift : forall n f, sum_below (S n) f = f 0%nat + sum_below n (fun k => f (S k))).
  { induction n as [| n IH]; intro f; [simpl; ring |]. simpl in *. rewrite IH. ring. }
  assert (zero : forall n f, (forall k, f k = 0) -> sum_below n f = 0).
  { induction n as [| n IH]; intros f all; simpl; [reflexivity |]. rewrite IH, all by auto. ring. }
  assert (no : Q2R 0 = 0) by (unfold Q2R; simpl; field).
  induction n as [| n IH]; intros u v short.
  - destruct u; [| simpl in short; lia]. simpl. exact no.
  - destruct u as [| x u'].
    + simpl dot. rewrite no. symmetry. apply zero. intro k. unfold real. destruct k; simpl; rewrite no; ring.
    + destruct v as [| y v'].
      * simpl dot. rewrite no. symmetry. apply zero. intro k. unfold real. destruct k; simpl; rewrite no; ring.
      * rewrite shift. cbn [dot]. rewrite Q2R_red, Q2R_plus, Q2R_mult, (IH u' v') by (simpl in short; lia).
        reflexivity.
Qed.

Lemma combination_dotted : forall n w cs vs, sum_below n (fun j => w j * combination cs vs j) =
  combination cs (map (fun v : vector => (fun _ : nat => sum_below n (fun j => w j * v j)) : vector) vs) 0%nat.
Proof.
  assert (zero : forall n f, (forall k, f k = 0) -> sum_below n f = 0).
  { induction n as [| n IH]; intros f all; simpl; [reflexivity |]. rewrite IH, all by auto. ring. }
  assert (linear : forall n c f g, sum_below n (fun j => c * f j + g j) = c * sum_below n f + sum_below n g).
  { induction n as [| n IH]; intros c f g; simpl; [ring |]. rewrite IH. ring. }
  intros n w. induction cs as [| c cs IH]; intro vs.
  - simpl. apply zero. intro. ring.
  - destruct vs as [| v vs]; [simpl; apply zero; intro; ring |].
    cbn [combination map]. rewrite <- IH.
    rewrite (sum_of_equals n _ (fun j => c * (w j * v j) + w j * combination cs vs j)) by (intros; ring).
    apply linear.
Qed.

Lemma combined_real : forall cs vs j, Q2R (combined cs vs j) = combination (map Q2R cs) (map real vs) j.
Proof.
  induction cs as [| c cs IH]; intros vs j.
  - simpl. unfold Q2R; simpl; field.
  - destruct vs as [| v vs]; [simpl; unfold Q2R; simpl; field |].
    cbn [combined map combination]. rewrite Q2R_red, Q2R_plus, Q2R_mult, IH. reflexivity.
Qed.

Lemma picked : forall (f : vector -> vector) k vs cs s,
  length cs = length vs -> (s <= k < s + length vs)%nat ->
  (forall i, (i < length vs)%nat -> f (nth i vs (fun _ => 0)) 0%nat = if Nat.eqb (s + i) k then 1 else 0) ->
  combination cs (map f vs) 0%nat = nth (k - s) cs 0.
Proof.
  intros f k. induction vs as [| v vs IH]; intros cs s same inside is; [simpl in inside; lia |].
  destruct cs as [| c cs]; [discriminate |]. cbn [map combination].
  pose proof (is 0%nat ltac:(simpl; lia)) as first. cbn [nth] in first. rewrite Nat.add_0_r in first. rewrite first.
  destruct (Nat.eq_dec s k) as [here | later].
  - subst k. rewrite Nat.eqb_refl, Nat.sub_diag. cbn [nth].
    assert (none : forall vs cs, (forall i, (i < length vs)%nat -> f (nth i vs (fun _ => 0)) 0%nat = 0) -> combination cs (map f vs) 0%nat = 0).
    { clear. induction vs as [| v vs IH]; intros [| c cs] all; try reflexivity. cbn [map combination].
      pose proof (all 0%nat ltac:(simpl; lia)) as at_v. cbn [nth] in at_v.
      rewrite at_v, IH; [ring |]. intros i less. apply (all (S i)). simpl. lia. }
    rewrite none; [ring |]. intros i less. pose proof (is (S i) ltac:(simpl; lia)) as at_i. cbn [nth] in at_i. rewrite at_i.
    destruct (Nat.eqb_spec (s + S i) s); [lia | reflexivity].
  - destruct (Nat.eqb_spec s k); [lia |]. replace (k - s)%nat with (S (k - S s)) by lia. cbn [nth].
    rewrite (IH cs (S s)); [ring | simpl in same; lia | simpl in inside; lia |].
    intros i less. pose proof (is (S i) ltac:(simpl; lia)) as at_i. cbn [nth] in at_i. rewrite at_i.
    replace (s + S i)%nat with (S s + i)%nat by lia. reflexivity.
Qed.

Lemma inverts_independent : forall n columns vs, forallb (fun c => Nat.leb (length c) n) columns = true ->
  length columns = length vs -> inverts columns vs = true -> independent n (map real vs).
Proof.
  intros n columns vs short same inverse cs sizes zero. rewrite map_length in sizes.
  apply Forall_nth. intros k d inside. rewrite (nth_indep cs d 0) by exact inside.
  set (w := real (nth k columns [])).
  assert (dotted : sum_below n (fun j => w j * combination cs (map real vs) j) = 0).
  { rewrite (sum_of_equals n _ (fun _ => 0)); [| intros j less; rewrite zero by exact less; ring].
    clear. induction n as [| n IH]; simpl; [reflexivity | rewrite IH; ring]. }
  rewrite combination_dotted, (picked _ k (map real vs) cs 0) in dotted.
  - rewrite Nat.sub_0_r in dotted. symmetry. exact dotted.
  - rewrite map_length. exact sizes.
  - rewrite map_length. lia.
  - intros i less. rewrite map_length in less. cbn beta.
    change (fun _ : nat => 0) with ((fun _ : nat => 0) : vector).
    assert (nth i (map real vs) (fun _ => 0) = real (nth i vs [])) as at_i.
    { rewrite (nth_indep (map real vs) (fun _ => 0) (real [])) by (rewrite map_length; exact less). apply map_nth. }
    rewrite at_i. unfold w. rewrite <- dot_below.
    + unfold inverts in inverse. rewrite forallb_forall in inverse.
      specialize (inverse i ltac:(apply in_seq; lia)). rewrite forallb_forall in inverse.
      specialize (inverse k ltac:(apply in_seq; lia)). apply Qeq_bool_eq, Qeq_eqR in inverse. rewrite inverse.
      cbn [Nat.add]. destruct (Nat.eqb i k); unfold Q2R; simpl; field.
    + rewrite forallb_forall in short. apply Nat.leb_le. apply short. apply nth_In. lia.
Qed.

Lemma spans_spanned : forall n columns vs v, length columns = length vs -> spans n columns vs v = true ->
  spanned n (map real vs) (real v).
Proof.
  intros n columns vs v same all. exists (map Q2R (map (fun c => dot c v) columns)). split.
  - rewrite !map_length. exact same.
  - intros j less. rewrite <- combined_real. unfold spans in all. rewrite forallb_forall in all.
    apply Qeq_eqR, Qeq_bool_eq. apply all. apply in_seq. lia.
Qed.

Theorem has_dimension_is : forall n vs d, has_dimension n vs d = true -> dimension n (map real vs) d.
Proof.
  intros n vs d found. unfold has_dimension in found.
  set (places := chosen n 0 [] vs) in *. set (basis := map (fun i => nth i vs []) places) in *.
  set (columns := right_inverse n basis) in *.
  apply andb_prop in found as [found all]. apply andb_prop in found as [found inverse].
  apply andb_prop in found as [found short]. apply andb_prop in found as [count sizes].
  apply Nat.eqb_eq in count, sizes.
  assert (same : length columns = length basis) by (unfold basis; rewrite map_length; lia).
  exists places.
  split; [exact count |].
  assert (at_place : forall i j, nth i (map real vs) (fun _ => 0) j = real (nth i vs []) j).
  { intros i j. destruct (Nat.lt_ge_cases i (length vs)) as [less | beyond].
    - rewrite (nth_indep (map real vs) (fun _ => 0) (real [])) by (rewrite map_length; exact less). rewrite map_nth. reflexivity.
    - rewrite !nth_overflow by (rewrite ?map_length; exact beyond). unfold real. destruct j; simpl; unfold Q2R; simpl; field. }
  assert (equal : forall cs j, combination cs (map (fun i => nth i (map real vs) (fun _ => 0)) places) j = combination cs (map real basis) j).
  { unfold basis. clear - at_place. induction places as [| i rest IH]; intros [| c cs] j; try reflexivity.
    cbn [map combination]. rewrite IH, at_place. reflexivity. }
  split.
  - intros cs sizes_cs zero. apply (inverts_independent n columns basis short same inverse).
    + unfold basis. rewrite !map_length in *. exact sizes_cs.
    + intros j less. rewrite <- equal. apply zero, less.
  - apply Forall_forall. intros v here. apply in_map_iff in here as [u [<- here]].
    rewrite forallb_forall in all. destruct (spans_spanned n columns basis u same (all u here)) as [cs [sizes_cs is_v]].
    exists cs. split.
    + unfold basis in sizes_cs. rewrite !map_length in *. exact sizes_cs.
    + intros j less. rewrite equal. apply is_v, less.
Qed.

(* ---- at a configuration ---- *)

(* Cosine and sine of a coordinate that is an angle there, or its length. *)
Inductive place := Angle (c s : Q) | Length (x : Q).

Definition stands (q : vector) (at_point : list place) : Prop :=
  forall i, match nth i at_point (Length 0) with
            | Angle c s => cos (q i) = Q2R c /\ sin (q i) = Q2R s
            | Length x => q i = Q2R x
            end.

Definition is_place (p : place) : bool :=
  match p with Angle c s => Qeq_bool (c * c + s * s) 1 | Length _ => true end.

Lemma some_angle : forall c s : R, c * c + s * s = 1 -> exists x, cos x = c /\ sin x = s.
Proof.
  intros c s circle. assert (within : -1 <= c <= 1) by nra.
  assert (root : sin (acos c) = sqrt (s * s)).
  { rewrite sin_acos by exact within. f_equal. unfold Rsqr. lra. }
  destruct (Rle_dec 0 s) as [up | down].
  - exists (acos c). split; [apply cos_acos, within |]. rewrite root. apply sqrt_square. exact up.
  - exists (- acos c). rewrite cos_neg, sin_neg. split; [apply cos_acos, within |].
    rewrite root. replace (s * s) with (- s * - s) by ring. rewrite sqrt_square by lra. ring.
Qed.

(* There is such a configuration. *)
Theorem somewhere : forall at_point, forallb is_place at_point = true -> exists q, stands q at_point.
Proof.
  intros at_point all.
  assert (each : forall i, exists x : R, match nth i at_point (Length 0) with
    | Angle c s => cos x = Q2R c /\ sin x = Q2R s | Length v => x = Q2R v end).
  { intro i. assert (is : is_place (nth i at_point (Length 0)) = true).
    { destruct (Nat.lt_ge_cases i (length at_point)) as [less | beyond].
      - rewrite forallb_forall in all. apply all, nth_In, less.
      - rewrite nth_overflow by exact beyond. reflexivity. }
    destruct (nth i at_point (Length 0)) as [c s | x]; [| exists (Q2R x); reflexivity].
    apply some_angle. apply Qeq_bool_eq, Qeq_eqR in is. rewrite Q2R_plus, !Q2R_mult in is. rewrite is.
    unfold Q2R; simpl; field. }
  clear all. revert each. intro each.
  assert (finite : forall n, exists q : vector, forall i, (i < n)%nat -> match nth i at_point (Length 0) with
    | Angle c s => cos (q i) = Q2R c /\ sin (q i) = Q2R s | Length v => q i = Q2R v end).
  { induction n as [| n [q before]]; [exists (fun _ => 0); lia |].
    destruct (each n) as [x here]. exists (moved q n x). intros i less.
    destruct (Nat.eq_dec i n) as [-> | other]; [rewrite moved_here; exact here |].
    rewrite moved_elsewhere by exact other. apply before. lia. }
  destruct (finite (length at_point)) as [q within]. exists (fun i => if Nat.ltb i (length at_point) then q i else 0).
  intro i. destruct (Nat.ltb_spec i (length at_point)) as [less | beyond]; [apply within, less |].
  rewrite nth_overflow by exact beyond. unfold Q2R; simpl; field.
Qed.

Fixpoint power (x : Q) (n : nat) : Q := match n with O => 1%Q | S k => Qred (x * power x k) end.

Definition triple_there (p : place) (t : nat * nat * nat) : option Q :=
  match p, t with
  | Angle c s, (O, b, e) => Some (power s b * power c e)%Q
  | Length x, (a, O, O) => Some (power x a)
  | _, _ => None
  end.

Fixpoint monomial_there (at_point : list place) (m : monomial) : option Q :=
  match m with
  | [] => Some 1%Q
  | t :: m' =>
      match triple_there (hd (Length 0) at_point) t, monomial_there (tl at_point) m' with
      | Some v, Some w => Some (Qred (v * w))
      | _, _ => None
      end
  end.

Fixpoint there (at_point : list place) (p : polynomial) : option Q :=
  match p with
  | [] => Some 0%Q
  | (m, v) :: p' =>
      match monomial_there at_point m, there at_point p' with
      | Some w, Some u => Some (Qred (v * w + u))
      | _, _ => None
      end
  end.

Lemma power_real : forall x n, Q2R (power x n) = Q2R x ^ n.
Proof.
  intros x n. induction n as [| n IH]; [simpl; unfold Q2R; simpl; field |].
  cbn [power pow]. rewrite Q2R_red, Q2R_mult, IH. reflexivity.
Qed.

Lemma one_real : Q2R 1 = 1.
Proof. unfold Q2R; simpl; field. Qed.

Lemma monomial_there_is : forall q m i at_point v,
  (forall j, match nth j at_point (Length 0) with
             | Angle c s => cos (q (i + j)%nat) = Q2R c /\ sin (q (i + j)%nat) = Q2R s
             | Length x => q (i + j)%nat = Q2R x end) ->
  monomial_there at_point m = Some v -> monomial_value q i m = Q2R v.
Proof.
  intro q. induction m as [| t m' IH]; intros i at_point v stands_there found.
  - injection found as <-. symmetry. apply one_real.
  - cbn [monomial_there] in found. cbn [monomial_value].
    destruct (triple_there (hd (Length 0) at_point) t) as [x |] eqn:here; [| discriminate].
    destruct (monomial_there (tl at_point) m') as [w |] eqn:rest; [| discriminate].
    assert (is : v = Qred (x * w)) by congruence. rewrite is, Q2R_red, Q2R_mult. f_equal.
    + pose proof (stands_there 0%nat) as first. rewrite Nat.add_0_r in first.
      replace (nth 0 at_point (Length 0)) with (hd (Length 0) at_point) in first by (destruct at_point; reflexivity).
      destruct (hd (Length 0) at_point) as [c s | l]; destruct t as [[a b] e].
      * destruct first as [is_c is_s]. unfold triple_there in here.
        destruct a; [| destruct b, e; discriminate]. injection here as <-.
        unfold power_of. rewrite is_c, is_s, Q2R_mult, !power_real. simpl. ring.
      * unfold triple_there in here. destruct b; [| destruct a; discriminate]. destruct e; [| destruct a; discriminate].
        injection here as <-. unfold power_of. rewrite first, power_real. simpl. ring.
    + apply (IH (S i) (tl at_point)); [| exact rest]. intro j.
      pose proof (stands_there (S j)) as next. replace (i + S j)%nat with (S i + j)%nat in next by lia.
      replace (nth (S j) at_point (Length 0)) with (nth j (tl at_point) (Length 0)) in next; [exact next |].
      destruct at_point; [destruct j; reflexivity | reflexivity].
Qed.

Lemma there_is : forall q at_point p v, stands q at_point -> there at_point p = Some v -> value q p = Q2R v.
Proof.
  intros q at_point p. unfold value. induction p as [| [m c] p' IH]; intros v standing found.
  - injection found as <-. unfold Q2R; simpl; field.
  - cbn [there value_from] in *.
    destruct (monomial_there at_point m) as [w |] eqn:here; [| discriminate].
    destruct (there at_point p') as [u |] eqn:rest; [| discriminate].
    assert (is : v = Qred (c * w + u)) by congruence. rewrite is, (IH u standing eq_refl), Q2R_red, Q2R_plus, Q2R_mult.
    rewrite (monomial_there_is q m 0 at_point w standing here). reflexivity.
Qed.

Fixpoint all_there (at_point : list place) (ps : list polynomial) : option (list Q) :=
  match ps with
  | [] => Some []
  | p :: rest => match there at_point p, all_there at_point rest with Some v, Some vs => Some (v :: vs) | _, _ => None end
  end.

Fixpoint fields_there (at_point : list place) (fields : list field) : option (list (list Q)) :=
  match fields with
  | [] => Some []
  | X :: rest => match all_there at_point X, fields_there at_point rest with Some v, Some vs => Some (v :: vs) | _, _ => None end
  end.

Lemma all_there_is : forall q at_point X v, stands q at_point -> all_there at_point X = Some v ->
  forall l, values q X l = real v l.
Proof.
  intros q at_point X. unfold values, component, real. induction X as [| p rest IH]; intros v standing found l.
  - injection found as <-. destruct l; unfold value; simpl; unfold Q2R; simpl; field.
  - cbn [all_there] in found.
    destruct (there at_point p) as [c |] eqn:here; [| discriminate].
    destruct (all_there at_point rest) as [vs |] eqn:others; [| discriminate].
    injection found as <-. destruct l as [| l]; cbn [nth].
    + apply (there_is q at_point p c standing here).
    + apply (IH vs standing eq_refl).
Qed.

Lemma dimension_of_equals : forall n vs ws d, Forall2 (fun v w : vector => forall j, v j = w j) vs ws ->
  dimension n ws d -> dimension n vs d.
Proof.
  intros n vs ws d same [places [count [free others]]].
  assert (at_place : forall i j, nth i vs (fun _ => 0) j = nth i ws (fun _ => 0) j).
  { clear - same. induction same as [| v w vs ws here rest IH]; intros [| i] j; try reflexivity; cbn [nth]; auto. }
  assert (equal : forall cs j, combination cs (map (fun i => nth i vs (fun _ => 0)) places) j
    = combination cs (map (fun i => nth i ws (fun _ => 0)) places) j).
  { clear - at_place. induction places as [| i rest IH]; intros [| c cs] j; try reflexivity.
    cbn [map combination]. rewrite IH, at_place. reflexivity. }
  exists places. split; [exact count |]. split.
  - intros cs sizes zero. apply free.
    + rewrite map_length in *. exact sizes.
    + intros j less. rewrite <- equal. apply zero, less.
  - assert (sizes : length (map (fun i => nth i vs (fun _ => 0)) places) = length (map (fun i => nth i ws (fun _ => 0)) places))
      by (rewrite !map_length; reflexivity).
    revert sizes others equal. generalize (map (fun i => nth i vs (fun _ => 0)) places), (map (fun i => nth i ws (fun _ => 0)) places).
    intros a b sizes others equal. clear - same others equal sizes.
    induction same as [| v w vs' ws' here rest IH]; [constructor |].
    inversion others as [| ? ? first later]; subst. constructor; [| apply IH; exact later].
    destruct first as [cs [count is]]. exists cs. split; [rewrite sizes; exact count |].
    intros j less. rewrite equal, is by exact less. symmetry. apply here.
Qed.

Lemma fields_there_is : forall q at_point X vs, stands q at_point -> fields_there at_point X = Some vs ->
  Forall2 (fun v w : vector => forall j, v j = w j) (map (values q) X) (map real vs).
Proof.
  intros q at_point X. induction X as [| x rest IH]; intros vs standing found.
  - injection found as <-. constructor.
  - cbn [fields_there] in found.
    destruct (all_there at_point x) as [v |] eqn:here; [| discriminate].
    destruct (fields_there at_point rest) as [ws |] eqn:others; [| discriminate].
    injection found as <-. constructor; [apply (all_there_is q at_point x v standing here) | apply IH; auto].
Qed.

Lemma dimension_there : forall q n at_point fields vs d, stands q at_point ->
  fields_there at_point fields = Some vs -> has_dimension n vs d = true -> dimension n (map (values q) fields) d.
Proof.
  intros q n at_point fields vs d standing found right.
  apply (dimension_of_equals n _ (map real vs)); [| apply has_dimension_is, right].
  apply fields_there_is with (at_point := at_point); assumption.
Qed.

(* ---- distributions ---- *)

(* Rows of constraints, fields that every row annihilates, functions that no field changes, a configuration. *)
Record distribution := {
  coordinates : nat;
  rows : list field;
  fields : list field;
  integrals : list polynomial;
  configuration : list place
}.

Definition annihilate (n : nat) (A : list field) (X : list field) : Prop :=
  forall q a x, In a A -> In x X -> sum_below n (fun k => values q a k * values q x k) = 0.

Definition differentials (d : distribution) : list field :=
  map (fun h => map (fun k => derived k h) (seq 0 (coordinates d))) (integrals d).

(* The fields are motions, as many as the rank of the rows leaves; their brackets of at most 1, 2, … have these
   dimensions; as many integrals as bring the last dimension to the number of coordinates. *)
Definition has_growth (d : distribution) (rank : nat) (growth : list nat) : Prop :=
  let n := coordinates d in
  annihilate n (rows d) (fields d) /\ annihilate n (differentials d) (fields d) /\
  (exists q, stands q (configuration d)) /\
  (rank + hd 0 growth = n)%nat /\ (last growth 0 + length (integrals d) = n)%nat /\
  forall q, stands q (configuration d) ->
    dimension n (map (values q) (rows d)) rank /\
    dimension n (map (values q) (differentials d)) (length (integrals d)) /\
    forall k, (k < length growth)%nat -> dimension n (map (values q) (up_to n (fields d) (S k))) (nth k growth 0%nat).

Definition vanish (n : nat) (A X : list field) : bool :=
  forallb (fun a => forallb (fun x => match products n a x with [] => true | _ => false end) X) A.

Definition dimension_is (n : nat) (at_point : list place) (fields : list field) (d : nat) : bool :=
  match fields_there at_point fields with Some vs => has_dimension n vs d | None => false end.

(* Each level from the one before. *)
Fixpoint climb (n : nat) (at_point : list place) (fields level : list field) (before : list (list Q)) (length : nat)
  (growth : list nat) : bool :=
  match growth with
  | [] => true
  | d :: rest =>
      match fields_there at_point level with
      | None => false
      | Some vs =>
          let reached := before ++ vs in
          has_dimension n reached d &&
          match rest with
          | [] => true
          | _ => climb n at_point fields (longer n fields level length) reached (S length) rest
          end
      end
  end.

Definition growth_is (d : distribution) (rank : nat) (growth : list nat) : bool :=
  let n := coordinates d in
  vanish n (rows d) (fields d) && vanish n (differentials d) (fields d) && forallb is_place (configuration d)
  && Nat.eqb (rank + hd 0%nat growth) n && Nat.eqb (last growth 0%nat + length (integrals d)) n
  && dimension_is n (configuration d) (rows d) rank
  && dimension_is n (configuration d) (differentials d) (length (integrals d))
  && climb n (configuration d) (fields d) (fields d) [] 1 growth.

Lemma vanish_annihilate : forall n A X, vanish n A X = true -> annihilate n A X.
Proof.
  intros n A X all q a x in_a in_x. unfold vanish in all. rewrite forallb_forall in all.
  specialize (all a in_a). rewrite forallb_forall in all. specialize (all x in_x).
  rewrite <- value_products. destruct (products n a x); [reflexivity | discriminate].
Qed.

Lemma fields_there_app : forall at_point xs ys vs ws, fields_there at_point xs = Some vs ->
  fields_there at_point ys = Some ws -> fields_there at_point (xs ++ ys) = Some (vs ++ ws).
Proof.
  intros at_point xs. induction xs as [| X rest IH]; intros ys vs ws first second.
  - injection first as <-. exact second.
  - cbn [fields_there app] in *. destruct (all_there at_point X) as [v |]; [| discriminate].
    destruct (fields_there at_point rest) as [us |] eqn:others; [| discriminate].
    injection first as <-. rewrite (IH ys us ws eq_refl second). reflexivity.
Qed.

Lemma climb_is : forall n at_point X growth length before,
  (1 <= length)%nat -> fields_there at_point (up_to n X (length - 1)) = Some before ->
  climb n at_point X (brackets n X length) before length growth = true ->
  forall k q, stands q at_point -> (k < List.length growth)%nat ->
    dimension n (map (values q) (up_to n X (length + k))) (nth k growth 0%nat).
Proof.
  intros n at_point X growth. induction growth as [| d rest IH]; intros m before positive known right k q standing less;
    [simpl in less; lia |].
  cbn [climb] in right. destruct (fields_there at_point (brackets n X m)) as [vs |] eqn:level; [| discriminate].
  apply andb_prop in right as [here more].
  assert (reached : fields_there at_point (up_to n X m) = Some (before ++ vs)).
  { destruct m as [| m']; [lia |]. cbn [up_to]. apply fields_there_app; [| exact level].
    replace (S m' - 1)%nat with m' in known by lia. exact known. }
  destruct k as [| k].
  - rewrite Nat.add_0_r. cbn [nth]. apply (dimension_there q n at_point _ _ d standing reached here).
  - cbn [nth]. replace (m + S k)%nat with (S m + k)%nat by lia.
    destruct rest as [| d' rest']; [simpl in less; lia |].
    apply (IH (S m) (before ++ vs)); try assumption.
    + lia.
    + replace (S m - 1)%nat with m by lia. exact reached.
    + destruct m as [| m']; [lia |]. exact more.
    + simpl in *. lia.
Qed.

Theorem growth_is_right : forall d rank growth, growth_is d rank growth = true -> has_growth d rank growth.
Proof.
  intros d rank growth right. unfold growth_is in right.
  repeat match goal with H : (_ && _)%bool = true |- _ => apply andb_prop in H as [? ?] end.
  repeat match goal with H : Nat.eqb _ _ = true |- _ => apply Nat.eqb_eq in H end.
  unfold has_growth. repeat split; try assumption.
  - apply vanish_annihilate. assumption.
  - apply vanish_annihilate. assumption.
  - apply somewhere. assumption.
  - match goal with H : dimension_is _ _ (rows d) _ = true |- _ => unfold dimension_is in H end.
    destruct (fields_there (configuration d) (rows d)) eqn:found; [| discriminate].
    eapply dimension_there; eassumption.
  - match goal with H : dimension_is _ _ (differentials d) _ = true |- _ => unfold dimension_is in H end.
    destruct (fields_there (configuration d) (differentials d)) eqn:found; [| discriminate].
    eapply dimension_there; eassumption.
  - intros k less. apply (climb_is (coordinates d) (configuration d) (fields d) growth 1 []); try assumption; auto.
Qed.

(* Computed once, where the proof is closed. *)
Ltac growth := apply growth_is_right; vm_cast_no_check (eq_refl true).


